#include "cli/laboratory/lab_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/solve/lab_statistics.hpp"

namespace pulvis::lab {

double Measured::standard() const {
  double squares = 0;
  for (const Contribution& c : contributions) squares += c.error * c.error;
  return std::sqrt(squares);
}

bool Measured::has_interval() const { return std::isfinite(standard()); }

double Measured::half_width(double confidence) const {
  constexpr double most_freedom = 1000;  // beyond it Student's distribution is effectively normal
  const double u = standard();
  if (!(u > 0) || !has_interval()) return u;
  const double share = contributions.front().error / u;
  const double degrees = freedom / (share * share * share * share);
  return u * student_quantile(confidence, static_cast<int>(std::clamp(degrees, 1.0, most_freedom)));
}

}  // namespace pulvis::lab
