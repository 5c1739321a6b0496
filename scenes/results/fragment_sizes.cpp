#include "scenes/results/fragment_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace pulvis {

std::vector<FragmentSize> fragment_sizes(std::span<const std::int32_t> fragment_of,
                                         std::span<const double> area_of) {
  std::map<std::int32_t, FragmentSize> found;
  for (std::size_t p = 0; p < fragment_of.size(); ++p) {
    FragmentSize& fragment = found[fragment_of[p]];
    fragment.number = fragment_of[p];
    fragment.particles += 1;
    fragment.area += area_of[p];
  }
  std::vector<FragmentSize> all;
  for (const auto& [number, fragment] : found) all.push_back(fragment);
  return all;
}

double equivalent_diameter(double area) { return std::sqrt(4 * area / std::numbers::pi); }

SizeDistribution::SizeDistribution(std::span<const FragmentSize> fragments, Weight weight) {
  std::vector<double> areas;
  for (const FragmentSize& fragment : fragments) areas.push_back(fragment.area);
  std::ranges::sort(areas);
  double sum = 0;
  for (const double area : areas) {
    diameters_.push_back(equivalent_diameter(area));
    shares_.push_back(sum += weight == Weight::area ? area : 1);
  }
  for (double& share : shares_) share /= sum;
}

// Sums of equal parts can miss a share by round-off.
double SizeDistribution::diameter(double share) const {
  constexpr double round_off = 1e-12;
  const auto at = std::ranges::lower_bound(shares_, share - round_off);
  return diameters_.at(
      static_cast<std::size_t>(std::min(at - shares_.begin(), std::ssize(shares_) - 1)));
}

}  // namespace pulvis
