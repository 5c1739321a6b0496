// Evaluates what a study expects across its runs against their curves.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cli/campaigns/study/analysis/study_spec.hpp"
#include "scenes/expectations.hpp"

namespace pulvis {

// The single number taken from a run, from samples of the series and of its abscissa. NaN if there is
// none: no sample in range, or a value that is never reached.
double figure_of(const StudyQuantity& quantity, std::span<const double> against,
                 std::span<const double> series);

// rms distance of each sample from the straight line through its neighbours (a twentieth of all, at least
// five), divided by the range of all; samples are assumed to be evenly spaced.
double roughness(std::span<const double> values);

// A series of one run; empty if the run has no results.
using SeriesOfRun = std::function<std::vector<double>(const StudyRun&, const std::string&)>;
// `failed` tells why a run has no valid results, or nothing.
using FailureOfRun = std::function<std::string(const StudyRun&)>;

void judge_bounds(Verdict& result, const StudyBounds& bounds, double value,
                  const std::string& unit);

std::string words_of(const StudyQuantity& quantity);  // "tool/top/force_y, largest"

// One verdict per expectation; not met if a run that it needs has failed.
std::vector<Verdict> judge_study(const Study& study, const SeriesOfRun& series,
                                 const FailureOfRun& failed);

}  // namespace pulvis
