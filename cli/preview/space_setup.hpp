// What the preview of a scene in three dimensions draws: its world at time zero, in SI units.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// materials, classes (with counts and sizes), particles (nodes of the surface and its faces), tools (pieces of their
// surfaces), stages.
nlohmann::json space_setup(const Scene& scene, const std::vector<BodySpec>& bodies,
                           const World& world);

}  // namespace pulvis
