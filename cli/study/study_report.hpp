// What a study leaves beside its runs:
//   study.csv     one row a run: what is varied, and its values
//   variations.csv  one row a variation: mean and standard deviation over its seeds
//   effects.csv   of every varied key and level the mean over all runs that have it, and its standard deviation
//   summary.json  the same with everything of each run's summary that was looked up, and the verdicts
//   curves.json   the curves as drawn: [{title, x, y, x_unit, y_unit, lines: [{variation, runs, x, y,
//                 low, high}]}], SI; low, high and standard_deviation where there are several seeds
//   fits.csv, strengths.csv  where the study has a [[fit]]: the parameters that were found, and the strength of every
//                 run with its probability of failure or its porosity
//   report.html   table, curves, spread and verdicts in one page, with links to the runs' own reports
#pragma once

#include <vector>

#include "cli/study/study_results.hpp"
#include "cli/study/study_runner.hpp"
#include "scenes/expectations.hpp"
#include "scenes/study/study_fits.hpp"

namespace pulvis {

struct StudyFindings {
  std::vector<Verdict> verdicts;
  std::vector<FittedLaw> fits;
};

void write_study(const std::filesystem::path& folder, const Study& study,
                 const std::vector<StudyResult>& results, const StudyFindings& findings,
                 const StudyTimes& times);

}  // namespace pulvis
