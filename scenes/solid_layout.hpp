// Which particle occupies which lane of which chunk.
#pragma once

#include <optional>
#include <vector>

#include "components/particle_classes.hpp"
#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "engine/entry.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// One particle in its lane.
struct Placed {
  const BodySpec* body = nullptr;
  Rotation turn = Rotation::Identity();  // from the frame of its mesh to the scene's
};

struct Layout {
  Bodies bodies;
  Shapes shapes;
  ParticleClasses classes;
  std::vector<std::optional<Placed>> placed;  // by slot; empty for empty slots
};

inline const Shape& shape_of(const Layout& layout, int slot) {
  return entry(layout.shapes.list, entry(layout.bodies.slots, slot).shape);
}

// Particles of one class after another, as many per chunk as it has lanes; within a class, ordered so that
// neighbours in space are close to each other. `bodies` must outlive it.
Layout lay_out(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
