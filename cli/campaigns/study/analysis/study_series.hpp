// Series that a study can name: those of a run's history, and those derived from them in a die.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/files/record.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// `time`, the history, and if the scene has them:
//   travel/<tool>        m, displacement of the tool since the first sample
//   pressure/<tool>      Pa, for the four tools of a die: force towards the tool over its face
//   transmission         -, F_bottom / F_top; NaN while F_top is below 5% of its maximum
// For levers: `actions` (how many are done) and the history of a programme, and values of the whole run, which are a
// single number instead of a time series: k_n, loop/friction ... (scenes/lever/afm_figures.hpp).
std::vector<SeriesInfo> study_series(const Scene& scene);

// The default abscissa of all samples; `placed`: if a position on it is given.
std::string study_abscissa(const Scene& scene, bool placed);

// The values of one of them; `history` returns those of the run.
using History = std::function<std::vector<double>(const std::string&)>;
std::vector<double> study_values(const Scene& scene, const std::string& name,
                                 const History& history);

}  // namespace pulvis
