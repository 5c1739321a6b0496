// contact_force: assembles what every contact does to a particle, as sampled and as other body, on its Bezier points, and
// from there on its surface nodes.
//
// Source   systems/space/contact/assembly.hpp
// Runs     after the narrow phase, before integrate
// Order    a particle sums its own candidates in their order, then its pairs as other body: the same bits for any number of threads
#include "engine/chunk_lane.hpp"
#include "engine/prefetch.hpp"
#include "systems/space/contact/assembly.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {
namespace {

// The points that touch stand scattered among many: their lines are asked for a few rows before they are needed.
void fetch_points(const contact_force::Pairs& pairs, Row<FaceContact> row) {
  if (pairs.touches(row) == 0) return;
  for (unsigned left = touching_points(&pairs.activation(row)); left != 0; left &= left - 1)
    prefetch(&pairs.point(row, ContactPoint::numbers * std::countr_zero(left)));
}

void add_own_rows(const contact_force::Pairs& pairs, const RowRange<FaceContact>& rows,
                  const FaceForces& own) {
  constexpr int rows_ahead = 8;
  const std::int64_t end = (*rows.end()).value;
  for (const Row<FaceContact> row : rows) {
    const std::int64_t ahead = row.value + rows_ahead;
    if (ahead < end) fetch_points(pairs, Row<FaceContact>(ahead));
    if (pairs.touches(row) == 0) continue;
    add_touching(&pairs.point(row), touching_points(&pairs.activation(row)),
                 own.on(pairs.pair(row, 1)));
  }
}

void add_pairs(const contact_force::Pairs& pairs, const ContactIndex& index, int slot,
               const FaceForces& own) {
  add_own_rows(pairs, RowRange<FaceContact>::of(index.sampled_begin, slot), own);
  const FacePairs& of = *pairs.of;
  for (int k = entry(of.other_begin, slot); k < entry(of.other_begin, slot + 1); ++k) {
    const OtherLoads::Pair& loads = entry(pairs.loads->pairs, entry(of.of_other, k));
    for (std::size_t i = 0; i < loads.face.size(); ++i)
      add_load(loads.load[i], own.on(loads.face[i]));
  }
}

void add_tools(const TouchingRows& tools, const ContactIndex& index, int slot,
               const FaceForces& own) {
  for (const Row<FaceToolContact> row : RowRange<FaceToolContact>::of(index.tool_begin, slot))
    if (tools.touches(row) != 0) add_sampled(&tools.force(row), own.on(tools.pair(row, 1)));
}

}  // namespace

[[gnu::flatten]] void contact_force::operator()(Chunk chunk) const {
  const Shape& shape = bodies.shape_of(chunk);
  double* all = &face_force.chunk(chunk)(Row<SurfaceFace>(0));
  const auto apart = static_cast<std::ptrdiff_t>(shape.faces.size()) * face_numbers;
  BorneFaces borne(shape.faces.size());
  for (int lane = 0; lane < lane_count; ++lane) {
    const int slot = ChunkLane(chunk, lane).slot();
    const FaceForces own{all + lane * apart, borne};
    if (pairs) add_pairs(*pairs, *index, slot, own);
    if (tools) add_tools(*tools, *index, slot, own);
  }
  const auto loads = load.chunk(chunk);
  std::vector<std::uint8_t> loaded(static_cast<std::size_t>(shape.surface_points()));
  to_points(shape, all, apart, borne, loads, loaded);
  to_nodes(shape, loads, loaded, net_load.chunk(chunk), node_force.chunk(chunk));
}

}  // namespace pulvis::space
