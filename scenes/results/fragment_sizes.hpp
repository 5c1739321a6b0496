// Size distribution of the fragments into which a powder has broken.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pulvis {

struct FragmentSize {
  std::int32_t number = 0;     // its lowest particle number
  std::int32_t particles = 0;  // number of its particles
  double area = 0;             // m^2, undeformed
};

// In the order of their numbers. Input per particle: the number of its fragment, and its area.
std::vector<FragmentSize> fragment_sizes(std::span<const std::int32_t> fragment_of,
                                         std::span<const double> area_of);

// m, of the circle with that area.
double equivalent_diameter(double area);

// The distribution of equivalent diameters, as in a sieve analysis.
class SizeDistribution {
 public:
  enum class Weight { number, area };
  SizeDistribution(std::span<const FragmentSize> fragments, Weight weight);

  // m, smallest diameter such that fragments up to it make up at least that share.
  double diameter(double share) const;
  // Ascending, each with the cumulative share of all fragments up to it.
  const std::vector<double>& diameters() const { return diameters_; }
  const std::vector<double>& shares() const { return shares_; }

 private:
  std::vector<double> diameters_, shares_;
};

}  // namespace pulvis
