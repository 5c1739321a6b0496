// The part of summary.json that a die compaction adds:
//   fits          {samples, pressure: [low, high], relative_density: [low, high],
//                  laws: [{law, parameters: [{name, value, unit}], rms, rms_unit, r_squared, rms_density}
//                         or {law, not_fitted: why}],
//                  curve: {pressure, relative_density, <law>: densities}}   thinned, for drawing
//   transmission  {wall_friction, poissons_ratio, shares: [{relative_density, height_over_width,
//                  lateral_ratio, measured, round_die, slot, slot_measured_ratio}]}, not_compared: why,
//                  or {not_measured: why}
#pragma once

#include <nlohmann/json.hpp>

#include "scenes/results/compaction_curve.hpp"

namespace pulvis {

void add_compaction(nlohmann::ordered_json& summary, const Scene& scene,
                    const CompactionCurve& curve);

}  // namespace pulvis
