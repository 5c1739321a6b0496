// Output files of a study, besides its runs:
//   study.csv     one row per run: varied keys and values
//   variations.csv  one row per variation: mean and standard deviation over its seeds
//   effects.csv   for every varied key and level the mean over all runs that have it, and its standard deviation
//   summary.json  the same, with everything that was read from each run's summary, and the verdicts
//   curves.json   the curves as drawn: [{title, x, y, x_unit, y_unit, lines: [{variation, runs, x, y,
//                 low, high}]}], SI; low, high and standard_deviation where there are several seeds
//   fits.csv, strengths.csv  if the study has a [[fit]]: the fitted parameters, and the strength of every
//                 run with its probability of failure or its porosity
//   report.html   table, curves, scatter and verdicts in one page, with links to the runs' own reports
#pragma once

#include <vector>

#include "cli/campaigns/study/analysis/study_fits.hpp"
#include "cli/campaigns/study/study_results.hpp"
#include "cli/campaigns/study/study_runner.hpp"
#include "scenes/expectations.hpp"

namespace pulvis {

struct StudyFindings {
  std::vector<Verdict> verdicts;
  std::vector<FittedLaw> fits;
};

void write_study(const std::filesystem::path& folder, const Study& study,
                 const std::vector<StudyResult>& results, const StudyFindings& findings,
                 const StudyTimes& times);

}  // namespace pulvis
