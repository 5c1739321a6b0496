// What the preview of an AFM scene draws: the meshed lever, its tip, the sample and the programme, in SI units.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scenes/lever/afm_build.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Outlines of the parts, from above, from the side and from the front, in the frame of the lever at rest: x along it
// from the clamp, y across, z up.
nlohmann::json lever_setup(const Scene& scene, const AfmModel& model);

}  // namespace pulvis
