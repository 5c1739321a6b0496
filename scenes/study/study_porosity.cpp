#include "scenes/study/study_porosity.hpp"

#include <cmath>

namespace pulvis {

PorosityFit fit_porosity(const std::vector<double>& porosity, const std::vector<double>& strength) {
  const double count = static_cast<double>(porosity.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < porosity.size(); ++i) {
    mean_x += porosity[i] / count;
    mean_y += std::log(strength[i]) / count;
  }
  for (std::size_t i = 0; i < porosity.size(); ++i) {
    const double x = porosity[i] - mean_x, y = std::log(strength[i]) - mean_y;
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  const double slope = xy / xx;
  return {std::exp(mean_y - slope * mean_x), -slope, xy * xy / (xx * yy)};
}

}  // namespace pulvis
