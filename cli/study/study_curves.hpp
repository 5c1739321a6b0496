// The curves of a study: one a variation, over several seeds their mean, standard deviation and the band between the
// smallest and the largest.
#pragma once

#include "cli/study/study_results.hpp"

namespace pulvis {

struct StudyLine {
  std::string variation;
  std::size_t runs = 0;
  std::vector<double> x, y;
  std::vector<double> low, high, deviation;  // over seeds, at the same x; empty of a single run
};

struct DrawnCurve {
  std::string title, x, y, x_unit, y_unit;
  std::vector<StudyLine> lines;
};

// Runs that reached their end only. Means over seeds are taken where all have got to; of an abscissa that
// turns back, up to where it turns first.
std::vector<DrawnCurve> study_curves(const Study& study, const std::vector<StudyResult>& results);

}  // namespace pulvis
