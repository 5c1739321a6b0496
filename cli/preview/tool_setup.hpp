// The tools of a scene of particles and the enclosure of its powder, as its preview draws them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// [{name, shape, point, normal, points, friction by material, ...}] at their initial positions.
nlohmann::json tool_setup(const Scene& scene, const World& world);

// What a constraint holds: {shape, holds, nodes, ...} at their initial positions.
nlohmann::json constraint_setup(const Scene& scene, const World& world, int number);

// The space between four tools: {left, right, bottom, top} as names, x and y of their faces. Null if there is none.
nlohmann::json die_setup(const Scene& scene, const nlohmann::json& tools);

// {corner, vectors}. Null without one.
nlohmann::json cell_setup(const World& world);

}  // namespace pulvis
