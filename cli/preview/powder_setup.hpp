// What the preview of a scene of particles draws: its world at time zero, in SI units.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// materials, friction, classes (with counts and sizes), particles, tools, bonds, stages; in two dimensions die, cell and
// regions.
nlohmann::json powder_setup(const Scene& scene, const std::vector<BodySpec>& particles,
                            const World& world);

struct ClassSize {      // m
  double diameter = 0;  // of the circle or sphere of equal area or volume
  std::optional<double> width, height;
};

// The class that the scene declares: sizes of a packing are classes of their own.
const ParticleSpec& base_of(const Scene& scene, const BodySpec& body);

}  // namespace pulvis
