// Which particle stands in which lane of which chunk.
#pragma once

#include <optional>
#include <vector>

#include "components/particle_classes.hpp"
#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "scenes/space/body_columns.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

struct Layout {
  Bodies bodies;
  Shapes shapes;
  ParticleClasses classes;
  std::vector<std::optional<Placed>> placed;  // by slot; nothing where nobody stands
};

// Particles of one class after the other, so many to a chunk as it has lanes; those of a class in an order that keeps
// neighbours in space near each other. `bodies` must outlive it.
Layout lay_out(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
