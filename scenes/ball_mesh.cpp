#include "scenes/ball_mesh.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace pulvis {
namespace {

// Points of the ball by their number on the grid of the cube [-n, n]^3 stretched by the layers: the
// same triple is the same node.
class BallGrid {
 public:
  BallGrid(SolidDraft& draft, const Vec3& centre, double radius, int across, double focus)
      : draft_(draft),
        centre_(centre),
        radius_(radius),
        n_(across),
        focus_(focus),
        layers_(std::max(1, across / 2)) {}

  // Core point (i, j, k), each 0..n.
  int core(int i, int j, int k) { return node({i, j, k, 0}, core_place(i, j, k)); }

  // Point of a shell: (i, j, k) on the core's surface, layer 0 is the core, layers() the ball's surface.
  int shell(const std::array<int, 3>& at, int layer) {
    const Vec3 inner = core_place(at[0], at[1], at[2]);
    Vec3 angle;
    for (int a = 0; a < 3; ++a)
      angle[a] = std::tan(0.25 * std::numbers::pi * line(a, at[static_cast<std::size_t>(a)]));
    const Vec3 outer = angle.normalized();
    const double t = 1 - std::pow(1 - static_cast<double>(layer) / layers_, focus_);
    return node({at[0], at[1], at[2], layer}, (1 - t) * inner + t * outer);
  }
  int layers() const { return layers_; }

 private:
  Vec3 core_place(int i, int j, int k) const {
    constexpr double half = 0.42;  // of the radius; the cube's corners reach 0.73
    return half * Vec3(line(0, i), line(1, j), line(2, k));
  }
  // Grid line between -1 and 1; those along x and y lie closer towards the poles.
  double line(int axis, int i) const {
    const double even = 2.0 * i / n_ - 1;
    return axis == 2 ? even : std::copysign(std::pow(std::abs(even), focus_), even);
  }
  int node(const std::array<int, 4>& key, const Vec3& unit) {
    const auto [entry, fresh] = nodes_.try_emplace(key, 0);
    if (fresh) entry->second = draft_.add_node(centre_ + radius_ * unit);
    return entry->second;
  }

  SolidDraft& draft_;
  Vec3 centre_;
  double radius_;
  int n_;
  double focus_;
  int layers_;
  std::map<std::array<int, 4>, int> nodes_;
};

void add_oriented(SolidDraft& draft, SolidMesh::Hexahedron corners) {
  turn_outside_out(draft.nodes, corners);
  draft.add_hexahedron(corners, SolidPart::tip, HexFormulation::solid);
}

std::array<int, 3> on_face(int axis, int value, int u, int v) {
  std::array<int, 3> at{};
  at[static_cast<std::size_t>(axis)] = value;
  at[static_cast<std::size_t>((axis + 1) % 3)] = u;
  at[static_cast<std::size_t>((axis + 2) % 3)] = v;
  return at;
}

void add_shells(SolidDraft& draft, BallGrid& grid, int n, BallMesh& ball) {
  for (int side = 0; side < 6; ++side)
    for (int u = 0; u < n; ++u)
      for (int v = 0; v < n; ++v) {
        const int value = side % 2 == 0 ? 0 : n;
        const std::array<std::array<int, 3>, 4> at{
            on_face(side / 2, value, u, v), on_face(side / 2, value, u + 1, v),
            on_face(side / 2, value, u + 1, v + 1), on_face(side / 2, value, u, v + 1)};
        for (int l = 0; l < grid.layers(); ++l) {
          SolidMesh::Hexahedron corners;
          for (std::size_t c = 0; c < 4; ++c) {
            corners[c] = grid.shell(at[c], l);
            corners[c + 4] = grid.shell(at[c], l + 1);
          }
          add_oriented(draft, corners);
        }
        std::array<int, 4> face;
        for (std::size_t c = 0; c < 4; ++c) face[c] = grid.shell(at[c], grid.layers());
        ball.faces.push_back(face);
      }
}

void list_lower_half(const SolidDraft& draft, BallMesh& ball) {
  std::map<std::int32_t, double> area;
  for (const auto& face : ball.faces) {
    const auto x = [&](std::size_t c) { return draft.nodes[static_cast<std::size_t>(face[c])]; };
    const double share = 0.125 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
    for (const int node : face) area[node] += share;
  }
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& [node, share] : area) {
    const double z = draft.nodes[static_cast<std::size_t>(node)].z();
    if (z < lowest) lowest = z, ball.pole = node;
    if (z >= ball.centre.z()) continue;
    ball.lower.push_back(node);
    ball.lower_area.push_back(share);
  }
}

struct NearestOnFace {
  double distance = std::numeric_limits<double>::infinity();
  std::array<double, 4> weights{};
  const std::array<int, 4>* face = nullptr;
};

// Gauss-Newton for the nearest point of a bilinear face, kept inside it.
void try_face(const SolidDraft& draft, const std::array<int, 4>& face, const Vec3& x,
              NearestOnFace& best) {
  PlaceInQuad at;
  const auto corner = [&](std::size_t c) { return draft.nodes[static_cast<std::size_t>(face[c])]; };
  Vec3 difference;
  for (int i = 0; i < 20; ++i) {
    const auto w = at.weights();
    difference = x - (w[0] * corner(0) + w[1] * corner(1) + w[2] * corner(2) + w[3] * corner(3));
    Eigen::Matrix<double, 3, 2> a;
    a.col(0) =
        0.25 * ((1 - at.eta) * (corner(1) - corner(0)) + (1 + at.eta) * (corner(2) - corner(3)));
    a.col(1) =
        0.25 * ((1 - at.xi) * (corner(3) - corner(0)) + (1 + at.xi) * (corner(2) - corner(1)));
    const Vec2 step = (a.transpose() * a).inverse() * (a.transpose() * difference);
    at.xi = std::clamp(at.xi + step.x(), -1.0, 1.0);
    at.eta = std::clamp(at.eta + step.y(), -1.0, 1.0);
  }
  const double distance = difference.norm();
  if (distance < best.distance) best = {distance, at.weights(), &face};
}

}  // namespace

BallMesh add_ball(SolidDraft& draft, const Vec3& centre, double radius, int across, double focus) {
  BallMesh ball;
  ball.centre = centre;
  BallGrid grid(draft, centre, radius, across, focus);
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
      for (int k = 0; k < across; ++k)
        add_oriented(draft,
                     {grid.core(i, j, k), grid.core(i + 1, j, k), grid.core(i + 1, j + 1, k),
                      grid.core(i, j + 1, k), grid.core(i, j, k + 1), grid.core(i + 1, j, k + 1),
                      grid.core(i + 1, j + 1, k + 1), grid.core(i, j + 1, k + 1)});
  add_shells(draft, grid, across, ball);
  list_lower_half(draft, ball);
  return ball;
}

void tie_to_ball(SolidDraft& draft, const BallMesh& ball, int node) {
  NearestOnFace best;
  Vec3& x = draft.nodes[static_cast<std::size_t>(node)];
  for (const auto& face : ball.faces) try_face(draft, face, x, best);
  x.setZero();
  auto& hanging = draft.hanging[static_cast<std::size_t>(node)];
  for (std::size_t c = 0; c < 4; ++c) {
    const int on = (*best.face)[c];
    x += best.weights[c] * draft.nodes[static_cast<std::size_t>(on)];
    hanging.push_back({on, best.weights[c]});
  }
}

}  // namespace pulvis
