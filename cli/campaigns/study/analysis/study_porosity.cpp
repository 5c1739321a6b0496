#include "cli/campaigns/study/analysis/study_porosity.hpp"

#include "cli/campaigns/study/analysis/study_power.hpp"

namespace pulvis {

PorosityFit fit_porosity(const std::vector<double>& porosity, const std::vector<double>& strength) {
  const LogLine line = fit_log_line(porosity, strength);
  return {line.at_zero, -line.slope, line.r_squared};
}

}  // namespace pulvis
