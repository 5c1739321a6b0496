// Which particle stands in which lane of which chunk, and the meshes of their classes, in two dimensions.
#pragma once

#include <array>
#include <vector>

#include "components/particle_classes.hpp"
#include "components/shape.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// One particle in its lane: which shape, and the turn from the shape's frame to the scene's.
struct Placed {
  const BodySpec* body;
  int number;
  double turn;  // rad, of the mesh in space: the body's angle and the mesh phase
};

// Particles of one class after the other, so many to a chunk as it has lanes; a mesh phase turns the mesh, not the shape
// (a disc's outline does not care), so that all particles of a class share one undeformed mesh. `bodies` must outlive it.
std::vector<std::vector<Placed>> placed_by_class(const Scene& scene,
                                                 const std::vector<BodySpec>& bodies);

struct Layout {
  Bodies bodies;
  ParticleClasses classes;
  std::vector<const Placed*> placed;  // [slots]; null where nobody stands
};

// `classes` must outlive it.
Layout lay_out(const Scene& scene, const std::vector<std::vector<Placed>>& classes,
               std::size_t particles);

// m, of every node of a mesh from where its particle stands, which turned it by `turn`.
std::vector<Vec2> turned_nodes(const Shape& shape, double turn);
// m, the same where it stands.
std::vector<Vec2> placed_nodes(const Shape& shape, const Placed& placed);
// m, of every slot where a particle stands.
std::vector<std::array<double, 3>> centres(const Layout& layout);
std::vector<double> elements_of_chunks(const Layout& layout);

}  // namespace pulvis
