// Two candidates processed at once, four Gauss points each: the data that the stages of a narrow phase pass on.
//
//   active_pairs.hpp   which candidates may touch in this step
//   projection.hpp     where their points are relative to the other surface (tools: tools/tool_projection.hpp)
//   own_outline.hpp    which of them see their own body
//   contact_law.hpp    their forces: pressure, damping, friction
//   contact_sums.hpp   the sums of a block
//   assembly.hpp       from the points to the nodes (contact_force)
#pragma once

#include <array>

#include "components/contact.hpp"
#include "engine/lane_memory.hpp"
#include "systems/contact/contact_kernel.hpp"

namespace pulvis {

// The lanes of one, then those of the other. The same candidate twice if one is left over.
template <class At>
using TwoCandidates = std::array<Row<At>, 2>;
template <class At>
int count_of(const TwoCandidates<At>& two) {
  return two[0] == two[1] ? 1 : 2;
}

inline constexpr unsigned all_lanes = (1U << lane_count) - 1;
inline constexpr unsigned all_of_a_half = (1U << edge_points) - 1;
// Bits of the points of one candidate, from the lanes of both.
constexpr unsigned half_of(unsigned bits, int half) { return bits >> (half * edge_points) & 15; }
inline constexpr std::array<unsigned, 4> lanes_of_halves{0x00, 0x0f, 0xf0, 0xff};

// The values of a candidate at its four points, for both.
template <class Access, class At>
Lane at_points(const Access& column, const TwoCandidates<At>& two, int first = 0) {
  return load_halves(&column(two[0], first), &column(two[1], first));
}
// One value per candidate, for both.
template <class Access, class At>
Lane at_candidates(const Access& column, const TwoCandidates<At>& two, int number) {
  return halves(column(two[0], number), column(two[1], number));
}

struct PointLanes {
  Lane x, y;
};

inline constexpr auto basis_at_points = [] {
  std::array<std::array<double, lane_count>, 4> n{};  // [control point][Gauss point of both]
  for (std::size_t l = 0; l < lane_count; ++l) {
    const auto all = kernels::basis(kernels::edge_u[l % edge_points]);
    for (std::size_t a = 0; a < 4; ++a) n[a][l] = all[a];
  }
  return n;
}();

// The Gauss points of two edges from their four control points each, which are contiguous.
inline PointLanes edge_points_at(const double* low, const double* high) {
  PointLanes p{};
  for (std::size_t a = 0; a < 4; ++a) {
    const Lane n = Lane::load(basis_at_points[a].data());
    p.x = fma(n, halves(low[2 * a], high[2 * a]), p.x);
    p.y = fma(n, halves(low[2 * a + 1], high[2 * a + 1]), p.y);
  }
  return p;
}

// Points in contact with periodic images, shifted to where they are relative to the particles themselves. `of_row`: m,
// shift of a row's image, or m/s, its velocity.
template <class At, class OfRow>
inline void move_to_images(const TwoCandidates<At>& two, const OfRow& of_row, PointLanes& p) {
  const std::array<double, 2> a = of_row(two[0]), b = of_row(two[1]);
  p.x -= halves(a[0], b[0]);
  p.y -= halves(a[1], b[1]);
}

// Result of a projection: position and motion of the points relative to the other surface.
struct PointMotion {
  Lane gap;        // m, > 0 in penetration
  Lane nx, ny;     // outward normal of the other surface
  Lane gap_rate;   // m/s
  Lane slip_rate;  // m/s, along t = (-ny, nx)
  Lane inv_slope;  // 1/m, 1/|x'| of the other curve, if it has one
};

// Response of the contact law.
struct PointForces {
  Lane x, y;           // N, on the sampled edge
  Lane along;          // N, its friction part, along t
  Lane elastic_slip;   // m, new value
  Lane pressure;       // Pa, in this pass
  Lane energy;         // J, stored
  Lane friction_work;  // J, dissipated in this step
  Lane damping_work;   // J, dissipated in this step
};

}  // namespace pulvis
