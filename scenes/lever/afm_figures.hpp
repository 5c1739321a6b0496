// Figures of an AFM run that summary.json tells and an [[expect]] may name: stiffnesses, shares, loops.
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

// Of every AFM run, and of its last friction loop and its last force curve where it has one.
std::vector<SeriesInfo> afm_figures();
std::vector<SeriesInfo> afm_figures_of(const Scene& scene);  // those the scene's run has
// The same, and its history where it has a programme.
std::vector<SeriesInfo> afm_expectable_series(const Scene& scene);

std::map<std::string, double> afm_figure_values(const Calibration& calibration,
                                                const std::vector<FrictionLoop>& loops,
                                                const std::vector<ForceCurveFigures>& curves);

}  // namespace pulvis
