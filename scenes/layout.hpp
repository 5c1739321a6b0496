// Which particle occupies which lane of which chunk, and the meshes of the particle classes, in two dimensions.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "components/particle_classes.hpp"
#include "components/shape.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// In [0, 1) from the top 53 bits: identical on every machine and standard library.
double uniform(std::mt19937_64& random);

// One particle in its lane: its shape, and the rotation from the shape's frame to the scene's.
struct Placed {
  const BodySpec* body;
  int number;
  double turn;  // rad, of the mesh in space: the body's angle plus the mesh phase
};

// Particles of one class after another, as many per chunk as it has lanes. A mesh phase rotates the mesh, not the shape
// (a disc's outline is unaffected), so all particles of a class share one undeformed mesh. `bodies` must outlive it.
std::vector<std::vector<Placed>> placed_by_class(const Scene& scene,
                                                 const std::vector<BodySpec>& bodies);

struct Layout {
  Bodies bodies;
  ParticleClasses classes;
  std::vector<const Placed*> placed;  // [slots]; null for empty slots
};

// `classes` must outlive it.
Layout lay_out(const Scene& scene, const std::vector<std::vector<Placed>>& classes,
               std::size_t particles);

// m, of every node of a mesh rotated by `turn`, relative to the position of its particle.
std::vector<Vec2> turned_nodes(const Shape& shape, double turn);
// m, the same in scene coordinates.
std::vector<Vec2> placed_nodes(const Shape& shape, const Placed& placed);
inline const Shape& shape_of(const Layout& layout, int slot) {
  return layout.bodies.shape_of_slot(slot);
}

// ---- of both dimensions ------------------------------------------------------------------------------
// m, of every occupied slot.
template <class Layout>
std::vector<std::array<double, 3>> centres(const Layout& layout) {
  std::vector<std::array<double, 3>> all(layout.placed.size());
  for (std::size_t slot = 0; slot < all.size(); ++slot)
    if (const auto& placed = layout.placed[slot]) {
      const Vec3& at = placed->body->position;
      all[slot] = {at.x(), at.y(), at.z()};
    }
  return all;
}

template <class Layout>
std::vector<double> elements_of_chunks(const Layout& layout) {
  std::vector<double> all;
  for (int chunk = 0; chunk < layout.bodies.chunks(); ++chunk)
    all.push_back(shape_of(layout, chunk * lane_count).elements());
  return all;
}

}  // namespace pulvis
