// The points of contact rows, gathered into one contact for each pair of bodies.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "components/cell.hpp"
#include "components/observed.hpp"

namespace pulvis {

// A point with a force on the sampled side; `normal` points into that side.
template <class D>
struct PointOfContact {
  typename D::Point at, normal, force;  // m, -, N
  double size;  // m or m^2, current length or area that belongs to the point
};

// Sums over a contact while its points are collected.
template <class D>
struct GatheredContact {
  using Point = typename D::Point;
  ContactLink<D> link;
  ImageIn<D> image{};  // of the second particle
  double weight = 0;

  // `side` is -1 if the sampled side is the link's second particle.
  void add(const PointOfContact<D>& p, double side) {
    const double force = std::sqrt(product(p.force, p.force));
    const double push = std::abs(product(p.force, p.normal));
    weight += force;
    link.size += p.size;
    for (std::size_t k = 0; k < D::axes; ++k) {
      link.point[k] += force * p.at[k];
      link.force[k] += side * p.force[k];
      link.normal[k] += side * push * p.normal[k];
    }
  }
  // `sides`: how many are sampled.
  ContactLink<D> finished(double sides) const {
    ContactLink<D> done = link;
    const double push = std::sqrt(product(link.normal, link.normal));
    for (std::size_t k = 0; k < D::axes; ++k) {
      done.point[k] /= weight;
      done.normal[k] /= push;
    }
    done.size /= sides;
    return done;
  }

 private:
  static double product(const Point& a, const Point& b) {
    double sum = 0;
    for (std::size_t k = 0; k < D::axes; ++k) sum += a[k] * b[k];
    return sum;
  }
};

// The contacts of one particle, by their other side.
template <class D>
class ContactsOfParticle {
 public:
  explicit ContactsOfParticle(int number) : number_(number) {}
  GatheredContact<D>& with(int second, const ImageIn<D>& image = {},
                           const typename D::Point& period = {}) {
    const auto same = [&](const GatheredContact<D>& g) {
      return g.link.second == second && g.image == image;
    };
    const auto found = std::ranges::find_if(all_, same);
    if (found != all_.end()) return *found;
    GatheredContact<D>& added = all_.emplace_back();
    added.link.first = number_;
    added.link.second = second;
    added.link.period = period;
    added.image = image;
    return added;
  }
  // Points may touch without a force, where the surfaces just meet: those form no contact.
  void move_to(std::vector<ContactLink<D>>& links, double sides) const {
    for (const GatheredContact<D>& g : all_)
      if (g.weight > 0) links.push_back(g.finished(sides));
  }

 private:
  int number_;
  std::vector<GatheredContact<D>> all_;
};

// Each contact belongs to its particle of lower number; of the two between a particle and its own image one is kept.
template <class D>
bool counts_for_first(int number, int other, const ImageIn<D>& image) {
  return other > number || (other == number && image > ImageIn<D>{});
}

template <class D>
void sort_by_numbers(std::vector<ContactLink<D>>& links) {
  std::ranges::sort(links, {},
                    [](const ContactLink<D>& l) { return std::pair(l.first, l.second); });
}

}  // namespace pulvis
