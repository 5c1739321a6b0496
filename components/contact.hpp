// Columns of contact: the smooth curves of the outlines, the tools, and the candidate pairs that may touch.
// A candidate is one boundary edge of a particle (the sampled side, four Gauss points) paired with one
// other particle or tool. Both particles of a pair sample each other: the contact is unbiased.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "components/dimension.hpp"
#include "components/entities.hpp"

namespace pulvis {

// Gauss points per boundary edge: one SIMD lane each, two edges side by side.
inline constexpr int edge_points = Contact::points;

// ---- contact curves ---------------------------------------------------------------------------
struct CurvePosition : Component<ControlPoint, double, 2> {
  static constexpr ComponentInfo info{"position", "m",
                                      "control point of the cubic B-spline outline"};
};
struct CurveVelocity : Component<ControlPoint, double, 2> {
  static constexpr ComponentInfo info{"velocity", "m/s", "of the control point"};
};

struct CurveBefore : Component<ControlPoint, double, 2> {
  static constexpr ComponentInfo info{"before", "m", "where it was when the candidates were made"};
};

struct CurveForce : Component<ControlPoint, double, 8> {
  static constexpr ComponentInfo info{"force", "N",
                                      "of all contacts on the edge whose first control point this "
                                      "is: x y of its four control points"};
  static constexpr bool transient = true;
};

// ---- tools (z = 0 in two dimensions) -----------------------------------------------------------
struct ToolPosition : Component<Tool, double, tool_axes> {
  static constexpr ComponentInfo info{"position", "m", "a point of the tool's surface"};
};
struct ToolVelocity : Component<Tool, double, tool_axes> {
  static constexpr ComponentInfo info{"velocity", "m/s", "mean over the last step"};
};
struct ToolNormal : Component<Tool, double, tool_axes> {
  static constexpr ComponentInfo info{"normal", "-", "from the tool into the powder"};
};
struct ToolForce : Component<Tool, double, tool_axes> {
  static constexpr ComponentInfo info{"force", "N", "of the particles, on the tool"};
};

// ---- candidates: the same columns for both kinds of contact ------------------------------------
template <class At>
struct ContactPair : Component<At, std::int32_t, 3> {
  static constexpr ComponentInfo info{"pair", "-",
                                      "stable key: particle slot, its edge, other slot or tool"};
};
// One byte each: systems that look for the few touching rows scan many of them.
template <class At>
struct ContactTouches : Component<At, std::uint8_t, 1> {
  static constexpr ComponentInfo info{"touches", "-",
                                      "1 where a point of the candidate touches, or 0"};
};
template <class At>
struct ReactivationDistance : Component<At, double, 1> {
  static constexpr ComponentInfo info{
      "activation", "m", "travel of the surfaces from which on the candidate is active again"};
};
// Set by the broad phase and read by the narrow phase, all together: one cache line per candidate, which has room for the
// areas of four points. (Those of sixteen are read from the shape.)
template <class At>
struct ContactLaw : Component<At, double, At::points == edge_points ? 4 + edge_points : 4> {
  static constexpr ComponentInfo info{
      "law", "SI",
      At::points == edge_points ? "kappa, Coulomb's mu, damping, 1/edge length; area of every point"
                                : "kappa, Coulomb's mu, damping, 1/face size"};
  enum Number {
    stiffness,  // Pa/m, kappa of the pair
    friction,   // -, Coulomb coefficient of the pair; 0 if the scene has none
    damping,    // Pa s/m, of the contact (T 5.1); 0 if the scene has none
    inv_size,   // 1/m, 1/undeformed size of the sampled edge (its length) or face
    weight      // m^2, undeformed area of a Gauss point: of the first of them
  };
};
// Points of an edge are summed one by one, those of a face eight at a time, a lane each: hence the two orders.
template <class At>
struct PointForce : Component<At, double, At::axes * At::points> {
  static constexpr ComponentInfo info{"point_force", "N",
                                      At::axes == 2
                                          ? "on the sampled edge: x y of every point"
                                          : "on the sampled face: x of every point, y, z"};
  static constexpr int number(int point, int axis) {
    return At::axes == 2 ? 2 * point + axis : At::points * axis + point;
  }
};

// Where the curves of a row start in the list of control points: saves looking up the shapes of its particles.
struct ContactPlace : Component<Contact, std::int32_t, 2> {
  static constexpr ComponentInfo info{
      "place", "-", "control points: first of the sampled edge, first of the other outline"};
};
// A point on the curve of an outline: an edge, given by its first control point in the outline, and the position on it.
struct CurvePoint;
// The same as one number, edge + parameter: a candidate's closest points then fit in beside the rest of its data.
struct PackedCurvePoint {
  double number = 0;
  constexpr CurvePoint unpacked() const;
};
struct CurvePoint {
  static constexpr double last_u = 1 - 1e-12;  // an end point belongs to its own edge
  int edge;
  double u;  // 0 ... 1
  constexpr PackedCurvePoint packed() const { return {edge + (u < last_u ? u : last_u)}; }
};
constexpr CurvePoint PackedCurvePoint::unpacked() const {
  const int edge = static_cast<int>(number);
  return {edge, number - edge};
}

// Closest point of each Gauss point on the other particle's curve.
struct ClosestPoint : Component<Contact, PackedCurvePoint, edge_points> {
  static constexpr ComponentInfo info{"closest_point", "-",
                                      "first control point of an edge of the other outline, from "
                                      "that outline's first, + parameter"};
};

// ---- only if the scene has friction --------------------------------------------------------------
// (Against other particles in three dimensions it is part of space::ContactPoint.)
template <class At>
struct ElasticSlip : Component<At, double, (At::axes == 2 ? 1 : 3) * At::points> {
  static constexpr ComponentInfo info{
      "elastic_slip", "m",
      At::axes == 2 ? "stretch of the tangential springs: history"
                    : "stretch of the tangential springs, x of all, y, z: history"};
};
// ---- only where surfaces indent --------------------------------------------------------------------
template <class At>
struct PointIndentation : Component<At, double, At::points> {
  static constexpr ComponentInfo info{"indentation", "m",
                                      "part of the gap that does not press any more: history"};
};
// Of an edge, or of a face.
template <class D>
struct SurfaceHardness : Component<typename D::OutlinePart, double, 3> {
  static constexpr ComponentInfo info{"hardness", "SI",
                                      "pressure per undeformed area at which it indents, share of "
                                      "an indentation left after the step, plastic strain of the "
                                      "element behind"};
  enum Number {
    pressure,  // Pa
    left,      // -
    strain     // -
  };
};
// ---- only if the friction of a pair is more than a Coulomb coefficient, or surfaces attract each other ----------
template <class At>
struct SurfaceLawNumber : Component<At, std::int32_t, 1> {
  static constexpr ComponentInfo info{"surface_law", "-",
                                      "which of the laws of the scene's surfaces acts"};
};
// ---- only if the friction of a pair is more than a Coulomb coefficient ----------------------------
template <class At>
struct SlipWeakening : Component<At, double, At::points> {
  static constexpr ComponentInfo info{"slip_weakening", "-",
                                      "share of the static friction lost in sliding: history"};
};

// Moment that keeps friction across a small gap from spinning up the pair; see contact_kernel.hpp.
struct SlopeLoad : Component<Contact, double, 2 * edge_points> {
  static constexpr ComponentInfo info{"slope_load", "N",
                                      "on the other curve's slope: x y of every point"};
};

// ---- sums over the rows -----------------------------------------------------------------------------
// Sums per block of rows, computed by the narrow phase while it has the rows at hand. Blocks depend on the chunks alone:
// not on threads, nor on what other rows a process has. The sum over the blocks is exact, so its bits do not depend on them.
template <class At>
struct RowBlocks {
  static constexpr const char* resource_name = At::blocks_name;
  static constexpr int most = At::rows_of_a_block;
  std::vector<std::int32_t> begin{0};  // [blocks + 1] into rows

  int count() const { return static_cast<int>(begin.size()) - 1; }
  // `slot_begin`: [slots + 1] into rows.
  void divide(const std::vector<std::int32_t>& slot_begin) {
    begin.assign(1, 0);
    for (std::size_t last = lane_count; last < slot_begin.size(); last += lane_count)
      while (begin.back() < slot_begin[last])
        begin.push_back(std::min(begin.back() + most, slot_begin[last]));
  }
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(begin);
  }
};

struct alignas(64) BlockSums {
  double energy = 0;                    // J, stored in the contact springs
  double friction_work = 0;             // J, dissipated by sliding in the last step
  double damping_work = 0;              // J, dissipated by contact damping in the last step
  double indentation_work = 0;          // J, spent by indenting surfaces in the last step
  double depth = 0;                     // -, largest penetration over edge length; NaN if any is
  std::int32_t deepest = -1;            // its row; -1 if nothing touches
  std::int32_t touching = 0;            // rows with a touching point
  std::int32_t projections = 0;         // closest-point projections
  std::int32_t unconverged = 0;         // projections that did not converge
  std::int32_t first_unconverged = -1;  // row of the first of them

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(energy, friction_work, damping_work, indentation_work, depth, deepest, touching,
          projections, unconverged, first_unconverged);
  }
};

template <class At>
struct ContactSums {
  static constexpr const char* resource_name =
      std::is_same_v<At, Contact> ? "contact_sums" : "tool_contact_sums";
  std::vector<BlockSums> blocks;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(blocks);
  }
};

}  // namespace pulvis
