// Bulk properties of a scene's powder, used to tune servos. In three dimensions the world must have its bodies with their
// shapes; its columns are not used: with several ranks, each has only those of its own bodies.
#pragma once

#include <vector>

#include "components/dimension.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct Powder {
  double mass = 0;       // kg
  double impedance = 0;  // Pa s/m, largest of its materials: density times dilatational wave speed
  double content = 0;    // m^2 or m^3, of all particles, undeformed
  Vec3 centre = Vec3::Zero();  // m, of mass
};

template <class D>
Powder powder_of(const World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

double volume_of_particles(const World& world);  // m^3, in three dimensions

// m by which contents and sections are multiplied for volumes and areas; 1 in three dimensions.
template <class D>
double thickness_of(const Scene& scene) {
  return D::axes == 2 ? scene.thickness : 1;
}

// What the particles cover perpendicular to a direction, with the room between them. In two dimensions a width, m, for which
// they count as discs of equal area. In three an area, m^2: of the convex polygon of 360 sides around their projections, in which
// they count as their bounding spheres, and does not depend on how the scene is rotated.
template <class D>
double section_across(const World& world, const Scene& scene, const std::vector<BodySpec>& bodies,
                      const Vec3& direction);

}  // namespace pulvis
