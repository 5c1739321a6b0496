// Size distribution of the fragments into which a powder has broken.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pulvis {

struct FragmentSize {
  std::int32_t number = 0;     // its lowest particle number
  std::int32_t particles = 0;  // number of its particles
  double size = 0;             // m^2, or in three dimensions m^3; undeformed
};

// In the order of their numbers. Input per particle: the number of its fragment, and its size.
std::vector<FragmentSize> fragment_sizes(std::span<const std::int32_t> fragment_of,
                                         std::span<const double> size_of);

// m, of the circle with that area, or of the sphere with that volume.
double equivalent_diameter(double size, int dimensions);

// The distribution of equivalent diameters, as in a sieve analysis.
class SizeDistribution {
 public:
  enum class Weight { number, size };
  SizeDistribution(std::span<const FragmentSize> fragments, Weight weight, int dimensions = 2);

  // m, smallest diameter such that fragments up to it make up at least that share.
  double diameter(double share) const;
  // Ascending, each with the cumulative share of all fragments up to it.
  const std::vector<double>& diameters() const { return diameters_; }
  const std::vector<double>& shares() const { return shares_; }

 private:
  std::vector<double> diameters_, shares_;
};

}  // namespace pulvis
