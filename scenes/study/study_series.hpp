// Series that a study can name: those of a run's history, and what is made of them in a die.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/files/record.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// `time`, the history, and where the scene has them:
//   travel/<tool>        m, displacement of the tool since the first sample
//   pressure/<tool>      Pa, of the four tools of a die: force towards the tool over its face
//   transmission         -, F_bottom / F_top; no number while F_top is below 1% of its largest value
// Of levers: `actions` (how many are done) and the history of a programme, and values of the whole run, which are no
// series in time but one number: k_n, loop/friction ... (scenes/lever/afm_figures.hpp).
std::vector<SeriesInfo> study_series(const Scene& scene);

// What all samples are in order of; `placed`: what a place among them is told by.
std::string study_abscissa(const Scene& scene, bool placed);

// The values of one of them; `history` gives those of the run.
using History = std::function<std::vector<double>(const std::string&)>;
std::vector<double> study_values(const Scene& scene, const std::string& name,
                                 const History& history);

}  // namespace pulvis
