// What the preview of a scene in two dimensions draws besides powder_setup.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "cli/preview/powder_setup.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// particles (outlines as meshed), bonded edges, tools, die, cell, regions.
nlohmann::json outline_setup(const Scene& scene, const std::vector<BodySpec>& particles,
                             const World& world);
nlohmann::json outline_class(const ParticleSpec& particle);
ClassSize outline_size(const ParticleSpec& particle);

}  // namespace pulvis
