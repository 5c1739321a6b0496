#include "scenes/results/fragment_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis {

std::vector<FragmentSize> fragment_sizes(std::span<const std::int32_t> fragment_of,
                                         std::span<const double> size_of) {
  std::map<std::int32_t, FragmentSize> found;
  for (std::size_t p = 0; p < fragment_of.size(); ++p) {
    FragmentSize& fragment = found[fragment_of[p]];
    fragment.number = fragment_of[p];
    fragment.particles += 1;
    fragment.size += size_of[p];
  }
  std::vector<FragmentSize> all;
  for (const auto& [number, fragment] : found) all.push_back(fragment);
  return all;
}

double equivalent_diameter(double size, int dimensions) {
  return dimensions == 3 ? portable::cbrt(6 * size / std::numbers::pi)
                         : std::sqrt(4 * size / std::numbers::pi);
}

SizeDistribution::SizeDistribution(std::span<const FragmentSize> fragments, Weight weight,
                                   int dimensions) {
  std::vector<double> sizes;
  for (const FragmentSize& fragment : fragments) sizes.push_back(fragment.size);
  std::ranges::sort(sizes);
  double sum = 0;
  for (const double size : sizes) {
    diameters_.push_back(equivalent_diameter(size, dimensions));
    shares_.push_back(sum += weight == Weight::size ? size : 1);
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
