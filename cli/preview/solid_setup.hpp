// What the preview of a scene in three dimensions draws besides powder_setup.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "cli/preview/powder_setup.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// particles (nodes of the surface and its faces), the number of bonded faces, tools (pieces of their surfaces).
nlohmann::json solid_setup(const Scene& scene, const std::vector<BodySpec>& particles,
                           const World& world);
nlohmann::json solid_class(const ParticleSpec& particle);
ClassSize solid_size(const ParticleSpec& particle);

}  // namespace pulvis
