#include "scenes/lever/mesh/tip_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "scenes/lever/mesh/ball_mesh.hpp"
#include "scenes/lever/mesh/foot_plan.hpp"
#include "scenes/lever/mesh/grading.hpp"
#include "scenes/lever/mesh/meshed_lever.hpp"
#include "scenes/lever/mesh/meshed_tip.hpp"

namespace pulvis {
namespace {

using TipShape = TipSpec::Shape;

LeverMesh::Point on_lower_face(const LeverMesh& lever, const Vec2& point) {
  auto place = lever.on_lower_face(point);
  if (!place) throw std::logic_error("tip_mesh: the tip is not on the lever");
  return *std::move(place);
}

// Layers of a plan, one below the other: `at(point of the plan, layer)` gives the position.
template <class At>
std::vector<int> add_column(SolidDraft& draft, const PlanMesh& plan, int layers, SolidPart part,
                            const At& at) {
  std::vector<int> first;
  for (int level = 0; level <= layers; ++level) {
    first.push_back(static_cast<int>(draft.nodes.size()));
    for (const Vec2& p : plan.points) draft.add_node(at(p, level));
  }
  for (int level = 0; level < layers; ++level)
    for (const auto& q : plan.quads) {
      SolidMesh::Hexahedron corners;
      for (std::size_t c = 0; c < 4; ++c) {
        corners[c] = first[static_cast<std::size_t>(level) + 1] + q[c];
        corners[c + 4] = first[static_cast<std::size_t>(level)] + q[c];
      }
      draft.add_hexahedron(corners, part, HexFormulation::solid);
    }
  return first;
}

void tie_to_lever(SolidDraft& draft, const LeverMesh& lever, int node) {
  draft.hang(node,
             on_lower_face(lever, draft.nodes[static_cast<std::size_t>(node)].head<2>()).gauge);
}

// Nodal shares of a uniform pressure on the end's faces: a six-node triangle takes it at its mid-edge nodes.
std::vector<SolidMesh::Support> area_shares(const SolidDraft& draft,
                                            const std::vector<std::vector<int>>& faces, int first) {
  std::map<int, double> share;
  double sum = 0;
  for (const auto& face : faces) {
    const bool triangle = face.size() == 6;
    const auto x = [&](std::size_t c) {
      return draft.nodes[static_cast<std::size_t>(first + face[c])];
    };
    const double area = 0.5 * (triangle ? (x(1) - x(0)).cross(x(2) - x(0)).norm()
                                        : (x(2) - x(0)).cross(x(3) - x(1)).norm());
    for (std::size_t c = triangle ? 3 : 0; c < face.size(); ++c)
      share[first + face[c]] += triangle ? area / 3 : area / 4;
    sum += area;
  }
  std::vector<SolidMesh::Support> supports;
  for (const auto& [node, area] : share) supports.push_back({node, area / sum});
  return supports;
}

std::vector<std::vector<int>> facets(const PlanMesh& plan) {
  std::vector<std::vector<int>> facets;
  for (const auto& q : plan.quads) facets.emplace_back(q.begin(), q.end());
  return facets;
}

TipMesh add_solid_tip(SolidDraft& draft, const LeverSpec& lever, const LeverMesh& mesh,
                      const TipSpec& tip) {
  const FootPlan foot = *foot_plan(lever, tip);
  const PlanMesh& plan = foot.unit;
  const double end = tip.shape == TipShape::block ? tip.foot : tip.end;
  const std::vector<double> depths = tip_levels(tip, foot.edge, lever.coarser);
  const Vec2 axis = tip_axis(lever, tip);
  const double top = on_lower_face(mesh, axis).z;
  const auto stacked = static_cast<int>(depths.size()) - 1;
  const auto first = add_column(draft, plan, stacked, SolidPart::tip, [&](const Vec2& p, int l) {
    const double depth = depths[static_cast<std::size_t>(l)], s = depth / tip.height;
    const Vec2 xy = axis + 0.5 * ((1 - s) * tip.foot + s * end) * p;
    return Vec3(xy.x(), xy.y(), top - depth);
  });
  for (std::size_t i = 0; i < plan.points.size(); ++i)
    tie_to_lever(draft, mesh, first.front() + static_cast<int>(i));
  return {area_shares(draft, facets(plan), first.back()), {}, {}};
}

// The default of eight edges is limited to the largest value that the key allows.
double contact_reach(const TipSpec& tip) {
  return tip.contact_reach.value_or(std::min(8 * tip.contact_edge.value_or(0), 0.5 * tip.radius));
}

// A node at x that follows the affine map that best fits the motion of the nodes from `first` on:
// it moves and rotates with them as a whole.
int add_carried_node(SolidDraft& draft, int first, const Vec3& x) {
  const auto count = static_cast<int>(draft.nodes.size()) - first;
  const auto at = [&](int i) { return draft.nodes[static_cast<std::size_t>(first + i)]; };
  Vec3 middle = Vec3::Zero();
  for (int i = 0; i < count; ++i) middle += at(i) / count;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (int i = 0; i < count; ++i) spread += (at(i) - middle) * (at(i) - middle).transpose();
  const Vec3 lever = spread.inverse() * (x - middle);
  std::vector<SolidMesh::Support> on;
  for (int i = 0; i < count; ++i)
    on.push_back({first + i, 1.0 / count + lever.dot(at(i) - middle)});
  const int node = draft.add_node(x);
  draft.hang(node, std::move(on));
  return node;
}

TipMesh add_sphere(SolidDraft& draft, const LeverSpec& lever, const LeverMesh& mesh,
                   const TipSpec& tip, const std::optional<Vec3>& out) {
  const Vec2 axis = tip_axis(lever, tip);
  const double top = on_lower_face(mesh, axis).z, r = tip.radius;
  const Vec3 centre(axis.x(), axis.y(), top - tip.neck_height - r);
  const auto first_of_ball = static_cast<int>(draft.nodes.size());
  const BallMesh ball =
      add_ball(draft, {centre, r, tip.elements, tip.contact_edge, contact_reach(tip)});

  const int carried = out ? add_carried_node(draft, first_of_ball, centre - r * *out) : -1;

  const PlanMesh plan = foot_plan(lever, tip)->unit;
  constexpr int layers = 2;
  const auto first = add_column(draft, plan, layers, SolidPart::glue, [&](const Vec2& p, int l) {
    const Vec2 off = tip.neck_radius * p;
    const double bottom = centre.z() + std::sqrt(r * r - off.squaredNorm());
    const double s = static_cast<double>(l) / layers;
    return Vec3(axis.x() + off.x(), axis.y() + off.y(), (1 - s) * top + s * bottom);
  });
  for (std::size_t i = 0; i < plan.points.size(); ++i)
    tie_to_lever(draft, mesh, first.front() + static_cast<int>(i));
  for (std::size_t i = 0; i < plan.points.size(); ++i)
    tie_to_ball(draft, ball, first.back() + static_cast<int>(i));
  if (carried >= 0) return {{{carried, 1.0}}, {}, {}};
  return {{{ball.pole, 1.0}}, ball.lower, ball.lower_area};
}

TipMesh add_meshed_tip(SolidDraft& draft, const LeverSpec& lever, const LeverMesh& mesh,
                       const TipSpec& tip) {
  if (!tip.solid) return {area_shares(draft, lever.solid->end, 0), {}, {}};
  const Vec2 axis = tip_axis(lever, tip);
  const Vec3 root(axis.x(), axis.y(), on_lower_face(mesh, axis).z);
  const int first = add_gmsh_solid(draft, tip.solid->solid, root, HexFormulation::solid);
  for (const int node : tip.solid->foot) tie_to_lever(draft, mesh, first + node);
  return {area_shares(draft, tip.solid->end, first), {}, {}};
}

}  // namespace

double tip_height(const TipSpec& tip) {
  return tip.shape == TipShape::sphere ? tip.neck_height + 2 * tip.radius : tip.height;
}

std::vector<double> tip_levels(const TipSpec& tip, double foot_edge, double coarser) {
  constexpr double longest = 0.5;  // -, of an element over the tip's mean width
  constexpr double growth = 1.2;
  const double end = tip.shape == TipShape::block ? tip.foot : tip.end;
  const double largest = longest * 0.5 * (tip.foot + end);
  return graded_lines({tip.height, foot_edge, std::min(end, largest), largest, growth, coarser}, 2);
}

TipMesh add_tip(SolidDraft& draft, const LeverSpec& lever, const LeverMesh& mesh,
                const TipSpec& tip, const std::optional<Vec3>& out) {
  if (tip.shape == TipShape::none) return {on_lower_face(mesh, tip_axis(lever, tip)).gauge, {}, {}};
  if (tip.shape == TipShape::sphere) return add_sphere(draft, lever, mesh, tip, out);
  if (tip.shape == TipShape::mesh) return add_meshed_tip(draft, lever, mesh, tip);
  return add_solid_tip(draft, lever, mesh, tip);
}

}  // namespace pulvis
