// The curves of a study: one per variation; over several seeds the mean, standard deviation and the band between the
// smallest and the largest.
#pragma once

#include "cli/campaigns/study/study_results.hpp"

namespace pulvis {

struct StudyLine {
  std::string variation;
  std::size_t runs = 0;
  std::vector<double> x, y;
  std::vector<double> low, high, deviation;  // over seeds, at the same x; empty for a single run
};

struct DrawnCurve {
  std::string title, x, y, x_unit, y_unit;
  std::vector<StudyLine> lines;
};

// Only runs that reached their end. Means over seeds are taken over the range that all runs cover; if the abscissa
// reverses, up to its first reversal.
std::vector<DrawnCurve> study_curves(const Study& study, const std::vector<StudyResult>& results);

}  // namespace pulvis
