// Columns of contact: the smooth curves of the outlines, tools, and the rows where they may touch.
// A contact row is one boundary edge of a particle (the sampled side, four Gauss points) against one
// other particle or tool. Both particles of a pair sample each other: the contact is unbiased.
#pragma once

#include "components/places.hpp"

namespace pulvis {

inline constexpr int edge_points =
    4;  // Gauss points of a boundary edge: one SIMD lane each, of two edges side by side

// ---- contact curves ---------------------------------------------------------------------------
struct CurvePosition : Component<ControlPoint, double, 2> {
  static constexpr ComponentInfo info{"position", "m",
                                      "control point of the cubic B-spline outline"};
};
struct CurveVelocity : Component<ControlPoint, double, 2> {
  static constexpr ComponentInfo info{"velocity", "m/s", "of the control point"};
};

struct CurveBefore : Component<ControlPoint, double, 2> {
  static constexpr ComponentInfo info{"before", "m",
                                      "where it was when the contact rows were made"};
};

struct CurveForce : Component<ControlPoint, double, 8> {
  static constexpr ComponentInfo info{"force", "N",
                                      "of all contacts on the edge whose first control point this "
                                      "is: x y of its four control points"};
  static constexpr bool transient = true;
};

// ---- tools ------------------------------------------------------------------------------------
struct ToolPosition : Component<Tool, double, 2> {
  static constexpr ComponentInfo info{"position", "m", "a point of the tool's surface"};
};
struct ToolVelocity : Component<Tool, double, 2> {
  static constexpr ComponentInfo info{"velocity", "m/s", "mean over the last step"};
};
struct ToolNormal : Component<Tool, double, 2> {
  static constexpr ComponentInfo info{"normal", "-", "from the tool into the powder"};
};
struct ToolForce : Component<Tool, double, 2> {
  static constexpr ComponentInfo info{"force", "N", "of the particles, on the tool"};
};

// ---- contact rows: the same columns for both kinds of contact ------------------------------------
template <class At>
struct ContactPair : Component<At, std::int32_t, 4> {
  static constexpr ComponentInfo info{
      "pair", "-",
      "stable key: particle slot, its edge, other slot or tool; then 1 where it touches"};
};
template <class At>
struct ContactReach : Component<At, double, 1> {
  static constexpr ComponentInfo info{"reach", "m",
                                      "travel at which the row must be looked at again"};
};
template <class At>
struct ContactStiffness : Component<At, double, 1> {
  static constexpr ComponentInfo info{"stiffness", "Pa/m", "kappa of the pair"};
};
template <class At>
struct ContactWeight : Component<At, double, edge_points> {
  static constexpr ComponentInfo info{"weight", "m^2",
                                      "undeformed area that a Gauss point stands for"};
};
template <class At>
struct EdgeLength : Component<At, double, 1> {
  static constexpr ComponentInfo info{"edge_length", "m", "undeformed length of the sampled edge"};
};
template <class At>
struct PointForce : Component<At, double, 2 * edge_points> {
  static constexpr ComponentInfo info{"point_force", "N",
                                      "on the sampled edge: x y of every point"};
};
template <class At>
struct Penetration : Component<At, double, 1> {
  static constexpr ComponentInfo info{"penetration", "m", "deepest of the row's points"};
};
template <class At>
struct ContactEnergy : Component<At, double, 1> {
  static constexpr ComponentInfo info{"energy", "J", "stored in the row's contact springs"};
};

// Closest point of each Gauss point on the other particle's curve: edge number + parameter in it.
struct ClosestPoint : Component<Contact, double, edge_points> {
  static constexpr ComponentInfo info{"closest_point", "-",
                                      "edge number + parameter on the other curve"};
};

// ---- only where the scene has friction -----------------------------------------------------------
template <class At>
struct FrictionCoefficient : Component<At, double, 1> {
  static constexpr ComponentInfo info{"friction", "-", "Coulomb coefficient of the pair"};
};
template <class At>
struct ElasticSlip : Component<At, double, edge_points> {
  static constexpr ComponentInfo info{"elastic_slip", "m",
                                      "stretch of the tangential springs: history"};
};
template <class At>
struct FrictionWork : Component<At, double, 1> {
  static constexpr ComponentInfo info{"friction_work", "J", "spent in sliding in the last step"};
};
// Moment that keeps friction across a small gap from spinning the pair; see contact_kernel.hpp.
struct FrictionCouple : Component<Contact, double, 2 * edge_points> {
  static constexpr ComponentInfo info{"friction_couple", "N",
                                      "on the other curve's slope: x y of every point"};
};

// ---- only where the scene has contact damping ------------------------------------------------------
template <class At>
struct DampingCoefficient : Component<At, double, 1> {
  static constexpr ComponentInfo info{"damping", "Pa s/m", "of the contact (T 5.1)"};
};
template <class At>
struct DampingWork : Component<At, double, 1> {
  static constexpr ComponentInfo info{"damping_work", "J",
                                      "spent by contact damping in the last step"};
};

}  // namespace pulvis
