#include "scenes/highest_mode.hpp"

#include <random>

#include "components/highest_mode.hpp"
#include "scenes/meshes/contact_curve.hpp"

namespace pulvis {
namespace {

// rho omega^2 / (k K) times area: an edge's spring matrix L/6 [[2,1],[1,2]] L/A is at most L/2 L/A on
// either of its nodes.
std::vector<double> supports(const Shape& shape) {
  std::vector<double> support(static_cast<std::size_t>(shape.boundary_nodes), 0);
  const std::vector<std::size_t> behind = elements_behind(shape);
  for (std::size_t i = 0; i < shape.edges.size(); ++i) {
    const double half = 0.5 * shape.edges[i].length * shape.edges[i].stiffness;
    const auto& quad = shape.quads[behind[i]];
    for (std::size_t c = 0; c < 4; ++c) {
      if (quad[c].value != static_cast<std::int32_t>(i)) continue;
      support[i] += half;
      support[static_cast<std::size_t>(quad[(c + 1) % 4].value)] += half;
    }
  }
  return support;
}

// The same for all particles of a class, so that it does not depend on memory layout. No symmetry: a guess
// must contain a component of every mode.
void guess(const Shape& shape, Lane* mode) {
  std::mt19937_64 random(1);
  for (std::size_t n = 0; n < shape.nodes.size(); ++n)
    for (std::size_t k = 0; k < 2; ++k)
      mode[HighestMode::count * n + k] = Lane(static_cast<double>(random() >> 11) * 0x1p-52 - 1);
}

}  // namespace

void add_highest_mode(World& world, const Bodies& bodies, const Needs& needs) {
  world.add<HighestMode>();
  world.add<ModeGain>();
  auto& mode = world.column<HighestMode>();
  if (needs.contact()) world.add<ContactSupport>();
  for (std::int32_t c = 0; c < bodies.chunks(); ++c) {
    const auto at = static_cast<std::size_t>(c);
    const Shape& shape = bodies.shape_of_chunk(Chunk{c});
    guess(shape, mode.lanes() + HighestMode::count * mode.table.chunk_begin[at]);
    if (!needs.contact()) continue;
    auto& support = world.column<ContactSupport>();
    Lane* of_chunk = support.lanes() + support.table.chunk_begin[at];
    for (const double s : supports(shape)) *of_chunk++ = Lane(s);
  }
}

}  // namespace pulvis
