// The particles with their shapes, as accesses of a system.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "engine/access.hpp"

namespace pulvis {

namespace space {

// The values at a face's sixteen Bezier points in a column of ParticleSurface.
struct PatchNumbers {
  const double* first;         // of the particle's first point
  const std::int32_t* number;  // Shape::Face::number
  double operator()(int k, int p) const { return first[number[p] + k]; }
};

}  // namespace space

template <class D>
struct ShapedBodies;
template <>
struct ShapedBodies<TwoD> {
  using Dimension = TwoD;
  Read<Bodies> bodies;

  const Shape& shape_of(int slot) const { return bodies->shape_of_slot(slot); }
  const Shape& shape_of(Chunk chunk) const { return bodies->shape_of_chunk(chunk); }
  // Of a particle's outline in the columns of outlines: index of its first number, and its points.
  std::ptrdiff_t outline_begin(int slot) const {
    return 2 * std::ptrdiff_t{entry(bodies->slots, slot).first_control};
  }
  int outline_points(int slot) const { return shape_of(slot).control_points(); }
  double depth() const { return bodies->thickness; }  // m, normal to the plane
};

template <>
struct ShapedBodies<ThreeD> {
  using Dimension = ThreeD;
  Read<Bodies> bodies;
  Read<space::Shapes> shapes;

  int slots() const { return static_cast<int>(bodies->slots.size()); }
  bool is_absent(int slot) const { return !bodies->is_present(slot); }
  const space::Shape& shape_of(int slot) const {
    return entry(shapes->list, entry(bodies->slots, slot).shape);
  }
  const space::Shape& shape_of(Chunk chunk) const { return shape_of(ChunkLane(chunk, 0).slot()); }
  // Of a particle's surface in the columns of ParticleSurface: index of its first number, and its points.
  std::ptrdiff_t outline_begin(int slot) const {
    return 3 * std::ptrdiff_t{entry(bodies->slots, slot).first_control};
  }
  int outline_points(int slot) const { return shape_of(slot).surface_points(); }
  space::PatchNumbers patch(std::span<const double> column, int slot, int face) const {
    return {column.data() + outline_begin(slot), entry(shape_of(slot).faces, face).number.data()};
  }
  static constexpr double depth() { return 1; }  // shapes have volumes, not areas
};

}  // namespace pulvis
