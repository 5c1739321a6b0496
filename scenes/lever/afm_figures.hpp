// Figures of an AFM run that summary.json lists and an [[expect]] may name: stiffnesses, shares, loops.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/files/record.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct Calibration;
struct FrictionLoop;
struct ForceCurveFigures;

// For every AFM run, and for its last friction loop and last force curve where it has them.
std::vector<SeriesInfo> afm_figures();
std::vector<SeriesInfo> afm_figures_of(const Scene& scene);  // those that a run of the scene has
// The same, plus the history where the scene has a programme.
std::vector<SeriesInfo> afm_expectable_series(const Scene& scene);

std::map<std::string, double> afm_figure_values(const Calibration& calibration,
                                                const std::vector<FrictionLoop>& loops,
                                                const std::vector<ForceCurveFigures>& curves);

}  // namespace pulvis
