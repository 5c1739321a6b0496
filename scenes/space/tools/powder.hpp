// What the powder of a scene is as a whole, from a world that has its bodies with their shapes. Its columns are not looked at:
// of several ranks each has those of its own bodies only.
#pragma once

#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// Planes and punches: whose normal says where the powder is.
bool has_face(const ToolSpec& tool);

struct Powder {
  double volume = 0;     // m^3, of all particles, undeformed
  double mass = 0;       // kg
  double impedance = 0;  // kg/(m^2 s), largest rho c of a material, c of plane waves
};
Powder powder_of(const World& world, const Scene& scene);

// m^2, of the box around the particles, across a direction; particles count as the balls that hold them.
double section_across(const World& world, const std::vector<BodySpec>& bodies,
                      const Vec3& direction);

}  // namespace pulvis::space
