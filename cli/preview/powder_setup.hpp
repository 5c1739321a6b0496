// What the preview of a scene of particles draws: its world at time zero, in SI units.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// materials, classes (with counts and sizes), particles (outlines as meshed), tools, die, cell, regions, bonds, stages.
nlohmann::json powder_setup(const Scene& scene, const std::vector<BodySpec>& particles,
                            const World& world);

// Also used in three dimensions.
nlohmann::json materials_setup(const Scene& scene);
nlohmann::json pairs_setup(
    const Scene& scene);  // friction between particles, for every pair of materials
nlohmann::json bond_laws(const Scene& scene);
void widen(nlohmann::json& range, double value);  // [lowest, highest], null before the first

}  // namespace pulvis
