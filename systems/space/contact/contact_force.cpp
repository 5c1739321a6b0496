// contact_force: assembles what every contact does to a particle, as sampled and as other body, on its Bezier points, and
// from there on its surface nodes.
//
// Source   systems/space/contact/assembly.hpp
// Runs     after the narrow phase, before integrate
// Order    a particle sums its own candidates in their order: the same bits for any number of threads
#include "engine/chunk_lane.hpp"
#include "engine/prefetch.hpp"
#include "systems/space/contact/assembly.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {
namespace {

// The candidates that touch are some among many and stand anywhere in a large powder: their lines are asked for before
// they are needed.
void fetch_other(const contact_force::Pairs& pairs, const std::vector<std::int32_t>& rows, int k) {
  constexpr int rows_ahead = 6;
  const int last = static_cast<int>(rows.size()) - 1;
  if (k + 2 * rows_ahead <= last)
    prefetch(&pairs.rows.touches(Row<FaceContact>(entry(rows, k + 2 * rows_ahead))));
  if (k + rows_ahead > last) return;
  const Row<FaceContact> row(entry(rows, k + rows_ahead));
  if (pairs.rows.touches(row) == 0) return;
  for (int line = 0; line < 6; ++line) prefetch(&pairs.rows.force(row, lane_count * line));
  for (int line = 0; line < 4; ++line) prefetch(&pairs.closest(row, lane_count * line));
}

void add_pairs(const contact_force::Pairs& pairs, const ContactIndex& index, int slot,
               const FaceForces& own) {
  for (const Row<FaceContact> row : RowRange<FaceContact>::of(index.sampled_begin, slot))
    if (pairs.rows.touches(row) != 0)
      add_sampled(&pairs.rows.force(row), own.on(pairs.rows.pair(row, 1)));
  for (int k = entry(index.other_begin, slot); k < entry(index.other_begin, slot + 1); ++k) {
    fetch_other(pairs, index.other_rows, k);
    const Row<FaceContact> row(entry(index.other_rows, k));
    if (pairs.rows.touches(row) != 0)
      add_other(&pairs.closest(row), &pairs.rows.force(row),
                pairs.couple ? &(*pairs.couple)(row) : nullptr, own);
  }
}

void add_tools(const TouchingRows<FaceToolContact>& tools, const ContactIndex& index, int slot,
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
  to_nodes(shape, loads, loaded, node_force.chunk(chunk));
}

}  // namespace pulvis::space
