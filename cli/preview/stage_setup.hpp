// The stages of a scene of particles, as its preview draws them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// [{name, kind, duration, moves, servos, until, cell, keep_state}], in SI units; absent entries are left out.
nlohmann::json stage_setup(const Scene& scene);

}  // namespace pulvis
