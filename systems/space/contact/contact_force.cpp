// contact_force: assembles all contact forces on a particle, as sampled and as other body, on its Bezier points, and
// from there on its surface nodes.
//
// Source   systems/space/contact/assembly.hpp
// Runs     after the narrow phases, before integrate
// Order    a particle sums its own candidates in order, then its pairs as other body: the same bits for any number of threads
#include <bit>

#include "engine/chunk_lane.hpp"
#include "systems/space/contact/assembly.hpp"
#include "systems/space/contact/node_springs.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {
namespace {

void add_own_rows(const contact_force::Pairs& pairs, int pair, const FaceForces& own) {
  const std::array<double, 3>* force = entry(pairs.loads->pairs, pair).own.data();
  for (const Row<FaceContact> row : RowRange<FaceContact>::of(pairs.of->begin, pair)) {
    if (pairs.touches(row) == 0) continue;
    const unsigned touching = touching_points(&pairs.activation(row));
    add_touching(force, touching, own.on(pairs.pair(row, 1)));
    force += std::popcount(touching);
  }
}

void add_pairs(const contact_force::Pairs& pairs, const ContactIndex& index, int slot,
               const FaceForces& own) {
  const FacePairs& of = *pairs.of;
  const std::int32_t end = entry(index.sampled_begin, slot + 1);
  for (int p = of.from_row(entry(index.sampled_begin, slot)); entry(of.begin, p) < end; ++p)
    add_own_rows(pairs, p, own);
  for (int k = entry(of.other_begin, slot); k < entry(of.other_begin, slot + 1); ++k) {
    const PairLoads::Pair& loads = entry(pairs.loads->pairs, entry(of.of_other, k));
    for (std::size_t i = 0; i < loads.face.size(); ++i)
      add_load(loads.load[i], own.on(loads.face[i]));
  }
}

void add_tools(const TouchingRows<FaceToolContact>& tools, const ContactIndex& index, int slot,
               const FaceForces& own) {
  for (const Row<FaceToolContact> row : RowRange<FaceToolContact>::of(index.tool_begin, slot))
    if (tools.touches(row) != 0) add_sampled(&tools.force(row), own.on(tools.pair(row, 1)));
}

// The springs of node_springs.hpp: acts on their points, and returns what acts on the nodes, x y z of each.
template <class Load>
[[gnu::noinline]] std::vector<Lane> pull_at_points(const contact_force& s, Chunk chunk,
                                                   const Load& load,
                                                   std::vector<std::uint8_t>& loaded) {
  const Shape& shape = s.bodies.shape_of(chunk);
  const Lane bulk = s.nodes.bulk.chunk(chunk)(Row<Particle>());
  std::vector<Lane> forces;
  for (int i = 0; i < static_cast<int>(shape.surface_node.size()); ++i) {
    const Shape::SurfaceNode& node = entry(shape.surface_node, i);
    const auto f = node_spring(node, away_from_surface(s.bodies, s.nodes, chunk, i), bulk).force;
    const Row<SurfacePoint> point(node.point);
    load(point, 0) -= f.x;
    load(point, 1) -= f.y;
    load(point, 2) -= f.z;
    entry(loaded, node.point) = 1;
    forces.insert(forces.end(), {f.x, f.y, f.z});
  }
  return forces;
}

}  // namespace

[[gnu::flatten]] void contact_force::operator()(Chunk chunk) const {
  const Shape& shape = bodies.shape_of(chunk);
  double* all = &loads.face.chunk(chunk)(Row<SurfaceFace>(0));
  const auto apart = static_cast<std::ptrdiff_t>(shape.faces.size()) * face_numbers;
  LoadedFaces loaded_faces(shape.faces.size());
  for (int lane = 0; lane < lane_count; ++lane) {
    const int slot = ChunkLane(chunk, lane).slot();
    const FaceForces own{all + lane * apart, loaded_faces};
    if (pairs) add_pairs(*pairs, *index, slot, own);
    if (tools) add_tools(*tools, *index, slot, own);
  }
  const auto load = loads.point.chunk(chunk);
  std::vector<std::uint8_t> loaded(static_cast<std::size_t>(shape.surface_points()));
  to_points(shape, all, apart, loaded_faces, load, loaded);
  std::vector<Lane> springs;
  if (nodes.any_rough(chunk)) springs = pull_at_points(*this, chunk, load, loaded);
  to_nodes(shape, load, loaded, loads.net.chunk(chunk), node_force.chunk(chunk));
  for (std::size_t i = 0; i < springs.size(); ++i)
    node_force.chunk(chunk)(Row<BoundaryNode>(static_cast<std::int32_t>(i / 3)),
                            static_cast<int>(i % 3)) += springs[i];
}

}  // namespace pulvis::space
