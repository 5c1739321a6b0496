// Nodal and element values, particle by particle: each rank of a run thus reports those of its own particles, and
// no rank holds the columns of all.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "engine/files/record.hpp"
#include "engine/world.hpp"

namespace pulvis {

// Appends the values of the particle in `slot`.
using ParticleValues = std::function<void(const World& world, int slot, std::vector<double>& out)>;
// A field of the mesh: its description, and its values particle by particle.
struct MeshField {
  FieldInfo info;
  ParticleValues values;
};
using ValueSink = std::function<void(std::span<const double>)>;

// Number of nodes or cells of the particle in `slot`; also of one that this process does not hold.
inline std::size_t places_in(const World& world, int slot, FieldPlace place) {
  const Bodies& bodies = world.resource<Bodies>();
  const bool nodes = place == FieldPlace::node;
  if (world.has<space::Shapes>()) {
    const space::Shape& shape =
        entry(world.resource<space::Shapes>().list, entry(bodies.slots, slot).shape);
    return nodes ? shape.nodes.size() : shape.hexahedra.size();
  }
  const Shape& shape = bodies.shape_of_slot(slot);
  return nodes ? shape.nodes.size() : shape.quads.size();
}

// The first row of column C that belongs to the particle in `slot`; its values are `lane_count` apart.
template <class C>
const double* first_value(const World& world, int slot) {
  const Column<C>& column = world.column<C>();
  const std::int32_t row = column.table.chunk_begin[static_cast<std::size_t>(slot / lane_count)];
  return column.values() + std::ptrdiff_t{row} * C::count * lane_count + slot % lane_count;
}

// `rows` of column C.
template <class C>
void append_rows(const World& world, int slot, std::size_t rows, std::vector<double>& out) {
  const double* at = first_value<C>(world, slot);
  for (std::size_t i = 0; i < rows * C::count; ++i) out.push_back(at[i * lane_count]);
}

}  // namespace pulvis
