// surface_hardness: the pressure at which each edge of an outline, or face of a surface, indents
// (systems/laws/normal_contact.hpp).
//
// Law      H = p + C sigma_f + p^2/(10 sigma_f) of the element behind, p its mean pressure (none if it is under tension),
//          times the stretch of the edge, or face: pressures are per undeformed area. The last term is small in powder with
//          pores. Without pores contacts are as wide as edges, and p is many times sigma_f and differs by more than that
//          between neighbouring elements: nothing indents. Indentations fade as the element flows, in the steps to the
//          next evaluation by as much as since the last one
// Runs     every few steps like stable_time_step, with the smooth outlines after integrate; the contacts of the next step
//          use its values
// Active   when the scene has contact.hardness
//
// What differs between the dimensions, `dilatation_of(shape, element, positions)`, is beside the instances:
// surface_hardness.cpp here, and systems/space/body/surface_hardness.cpp.
#pragma once

#include <array>

#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/body/systems.hpp"
#include "systems/laws/normal_contact.hpp"

namespace pulvis {

inline constexpr double closed_pores = 0.1;  // -, of the term in p^2

inline const auto& parts_of_boundary(const Shape& shape) { return shape.edges; }
inline const auto& parts_of_boundary(const space::Shape& shape) { return shape.faces; }

// Its place among the particle's rows of SurfaceHardness, and their number.
inline int place_of(const Shape::Edge& edge, int) { return edge.first_control; }
inline int place_of(const space::Shape::Face&, int number) { return number; }
inline int places_of(const Shape& shape) { return shape.control_points(); }
inline int places_of(const space::Shape& shape) { return static_cast<int>(shape.faces.size()); }

template <class Positions>
Lane stretch_of(const Shape::Edge& edge, const Positions& x) {
  const Lane dx = x(edge.ends[1], 0) - x(edge.ends[0], 0),
             dy = x(edge.ends[1], 1) - x(edge.ends[0], 1);
  return sqrt(dx * dx + dy * dy) * (1 / edge.length);
}
template <class Positions>
Lane stretch_of(const space::Shape::Face& face, const Positions& x) {
  std::array<Lane, 3> p, q;  // diagonals
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](std::size_t corner) { return x(Row<Node>(face.corner[corner].value), k); };
    entry(p, k) = at(2) - at(0);
    entry(q, k) = at(3) - at(1);
  }
  const Lane a = p[1] * q[2] - p[2] * q[1], b = p[2] * q[0] - p[0] * q[2],
             c = p[0] * q[1] - p[1] * q[0];
  return sqrt(a * a + b * b + c * c) * (0.5 / (face.size * face.size));
}

template <class F>
[[gnu::flatten]] void surface_hardness<F>::operator()(Chunk chunk) const {
  if (settings.clock->step < settings.clock->next_look) return;
  const bool first_time = settings.clock->step == 0;
  const Row<Particle> particle;
  const auto& shape = bodies.shape_of(chunk);
  const auto x = position.chunk(chunk);
  const auto eps = strain.chunk(chunk);
  const Lane k = bulk.chunk(chunk)(particle);
  // The flow stress of rate-dependent materials depends on more than what is known here: they do not indent.
  const double factor = flow.laws && (*flow.laws)->of_chunk(*bodies.bodies, chunk).rate.index() != 0
                            ? kernels::no_hardness
                            : settings.rules->hardness;
  double* first = &hardness.chunk(chunk)(Row<typename F::Dimension::OutlinePart>(0));
  using Number = SurfaceHardness<typename F::Dimension>;
  const std::ptrdiff_t apart = std::ptrdiff_t{Number::count} * places_of(shape);
  const auto set_all = [&](const auto& law) {
    const auto& parts = parts_of_boundary(shape);
    for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
      const auto& part = entry(parts, i);
      const Lane theta = dilatation_of(shape, part.element, x);
      const Lane pressure = max(0.5 * k * (1.0 / theta - theta), 0.0);
      Lane mean{};
      for (int g = 0; g < F::points; ++g) mean += eps(Row<Element>(part.element), g);
      mean *= 1.0 / F::points;
      const Lane flow_stress = law.flow_stress(mean);
      const Lane value = stretch_of(part, x) * (pressure + factor * flow_stress +
                                                closed_pores * pressure * pressure / flow_stress);
      for (int l = 0; l < lane_count; ++l) {
        double* number = first + l * apart + Number::count * place_of(part, i);
        number[Number::pressure] = value[l];
        const double flow = first_time ? 0 : mean[l] - number[Number::strain];
        number[Number::left] = 1 / (1 + flow / (max_steps_between_looks * kernels::fitting_strain));
        number[Number::strain] = mean[l];
      }
    }
  };
  const kernels::LinearHardening<Lane> linear{flow.yield_stress.chunk(chunk)(particle),
                                              flow.hardening.chunk(chunk)(particle)};
  if (flow.laws)
    with_hardening((*flow.laws)->of_chunk(*bodies.bodies, chunk), linear, set_all);
  else
    set_all(linear);
}
}  // namespace pulvis
