#include "scenes/highest_mode.hpp"

#include <random>

#include "components/body.hpp"
#include "components/highest_mode.hpp"
#include "engine/entry.hpp"
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

// A face's spring matrix is at most A/4 A/V on each of its nodes.
std::vector<double> supports(const space::Shape& shape) {
  std::vector<double> support(static_cast<std::size_t>(shape.boundary_nodes), 0);
  for (const space::Shape::Face& face : shape.faces)
    for (const auto corner : face.corner)
      entry(support, corner) += 0.25 * face.size * face.size * face.stiffness;
  return support;
}

// The same for all particles of a class but for their rotation, so that it depends neither on the memory layout nor on the
// frame: random combinations of vectors between nodes. No symmetry: a guess must contain a component of every mode.
template <class D>
void guess(std::size_t nodes, const Lane* position, Lane* mode) {
  std::mt19937_64 random(1);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  constexpr std::size_t axes = D::axes;
  for (std::size_t n = 0; n < nodes; ++n) {
    for (std::size_t k = 0; k < axes; ++k) mode[HighestMode<D>::count * n + k] = Lane{};
    for (std::size_t i = 1; i <= axes; ++i) {
      const std::size_t other = (n + i * nodes / (axes + 1) + i) % nodes;
      const double share = number();
      for (std::size_t k = 0; k < axes; ++k)
        mode[HighestMode<D>::count * n + k] +=
            share * (position[axes * other + k] - position[axes * n + k]);
    }
  }
}

// `shape_of`: of a chunk.
template <class D, class ShapeOf>
void add_columns(World& world, const Bodies& bodies, const ShapeOf& shape_of, bool contact) {
  world.add<HighestMode<D>>();
  auto& mode = world.column<HighestMode<D>>();
  world.add<ModeGain>();
  if (contact) world.add<ContactSupport>();
  for (std::int32_t c = 0; c < bodies.chunks(); ++c) {
    const auto& shape = shape_of(c);
    const std::int32_t first = entry(mode.table.chunk_begin, c);
    guess<D>(shape.nodes.size(), world.column<Position<D>>().lanes() + D::axes * first,
             mode.lanes() + HighestMode<D>::count * first);
    if (!contact) continue;
    auto& support = world.column<ContactSupport>();
    Lane* of_chunk = support.lanes() + entry(support.table.chunk_begin, c);
    for (const double s : supports(shape)) *of_chunk++ = Lane(s);
  }
}

}  // namespace

void add_highest_mode(World& world, const Bodies& bodies, bool contact) {
  add_columns<TwoD>(
      world, bodies, [&](int chunk) -> const Shape& { return bodies.shape_of_chunk(Chunk{chunk}); },
      contact);
}

void add_highest_mode(World& world, const Bodies& bodies, const space::Shapes& shapes,
                      bool contact) {
  add_columns<ThreeD>(
      world, bodies,
      [&](int chunk) -> const space::Shape& {
        return entry(shapes.list, entry(bodies.slots, chunk * lane_count).shape);
      },
      contact);
}

}  // namespace pulvis
