// Global properties of a scene's powder, from a world that has its bodies with their shapes. Its columns are not used:
// with several ranks, each has only those of its own bodies.
#pragma once

#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

struct Powder {
  double volume = 0;     // m^3, of all particles, undeformed
  double mass = 0;       // kg
  double impedance = 0;  // kg/(m^2 s), largest rho c of a material, c of plane waves
};
Powder powder_of(const World& world, const Scene& scene);

// m^2, area that the particles cover perpendicular to a direction, with the room between them: of the convex polygon of 360
// sides around their projections. Particles count as their bounding spheres. It does not depend on how the scene is rotated.
double section_across(const World& world, const std::vector<BodySpec>& bodies,
                      const Vec3& direction);

}  // namespace pulvis::space
