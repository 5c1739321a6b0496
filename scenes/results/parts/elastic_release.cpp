#include "scenes/results/parts/elastic_release.hpp"

#include <algorithm>

namespace pulvis {
namespace {

constexpr double least_release = 0.1;  // -, of the largest stored energy

}  // namespace

void ElasticRelease::sample(double load, double elastic, double contact) {
  largest_stored_ = std::max(largest_stored_, elastic + contact);
  if (load >= peak_load_) {
    peak_load_ = load;
    elastic_at_peak_ = elastic;
    contact_at_peak_ = contact;
    return;
  }
  const double from_elements = elastic_at_peak_ - elastic,
               from_springs = contact_at_peak_ - contact;
  if (!(from_elements + from_springs > elastic_ + contact_)) return;
  elastic_ = from_elements;
  contact_ = from_springs;
}

std::optional<double> ElasticRelease::share() const {
  const double released = elastic_ + contact_;
  if (!(released > 0) || released < least_release * largest_stored_) return std::nullopt;
  return contact_ / released;
}

}  // namespace pulvis
