#include "scenes/lever/mesh/ball_mesh.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/lever/mesh/ball_cells.hpp"

namespace pulvis {
namespace {

// Points of the ball by their keys: equal keys are the same node.
class BallGrid {
 public:
  BallGrid(SolidDraft& draft, const BallShape& shape, const BallCells& cells)
      : draft_(draft), shape_(shape), across_(cells.across()), layers_(cells.layers()) {}

  Vec3 place(const BallKey& at) const {
    constexpr double half = 0.42;  // of the radius; the cube's corners reach 0.73
    Vec3 inner, angle;
    for (int a = 0; a < 3; ++a) {
      const double line = 2.0 * at[static_cast<std::size_t>(a)] / across_ - 1;
      inner[a] = half * line;
      angle[a] = portable::tan(0.25 * std::numbers::pi * line);
    }
    const double t = static_cast<double>(at[3]) / layers_;
    const Vec3 unit = t == 0 ? inner : Vec3((1 - t) * inner + t * angle.normalized());
    return shape_.centre + shape_.radius * unit;
  }
  int node(const BallKey& at) {
    const auto [entry, fresh] = nodes_.try_emplace(at, 0);
    if (fresh) entry->second = draft_.add_node(place(at));
    return entry->second;
  }

 private:
  SolidDraft& draft_;
  BallShape shape_;
  int across_, layers_;
  std::map<BallKey, int> nodes_;
};

// As small as `edge` where it may touch, and larger by half the distance outside.
void divide_at_pole(BallCells& cells, const BallGrid& grid, const BallShape& shape) {
  const Vec3 pole = shape.centre - shape.radius * Vec3::UnitZ();
  cells.divide([&](const BallCell& cell) {
    std::array<Vec3, 8> x;
    for (std::size_t c = 0; c < 8; ++c) x[c] = grid.place(cell[c]);
    double nearest = std::numeric_limits<double>::infinity(), size = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      nearest = std::min(nearest, (x[c] - pole).norm());
      size = std::max(size, (x[c] - x[c < 4 ? (c + 1) % 4 : c - 4]).norm());
    }
    return size > *shape.edge + 0.5 * std::max(0.0, nearest - shape.reach);
  });
}

void hang_between(SolidDraft& draft, BallGrid& grid, const BallCells& cells) {
  for (const auto& hanging : cells.hanging()) {
    const int node = grid.node(hanging.point);
    Vec3& x = draft.nodes[static_cast<std::size_t>(node)];
    x.setZero();
    std::vector<SolidMesh::Support> on;
    for (const BallKey& key : hanging.on) {
      on.push_back({grid.node(key), 1.0 / static_cast<double>(hanging.on.size())});
      x += on.back().weight * draft.nodes[static_cast<std::size_t>(on.back().node)];
    }
    draft.hang(node, std::move(on));
  }
}

// The area of a hanging node is passed on to the nodes it hangs on.
void share_area(const SolidDraft& draft, int node, double share,
                std::map<std::int32_t, double>& area) {
  const auto& hanging = draft.hanging[static_cast<std::size_t>(node)];
  if (hanging.empty()) area[node] += share;
  for (const auto& support : hanging) share_area(draft, support.node, support.weight * share, area);
}

void list_lower_half(const SolidDraft& draft, BallMesh& ball) {
  std::map<std::int32_t, double> area;
  for (const auto& face : ball.faces) {
    const auto x = [&](std::size_t c) { return draft.nodes[static_cast<std::size_t>(face[c])]; };
    const double share = 0.125 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
    for (const int node : face) share_area(draft, node, share, area);
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

// Gauss-Newton for the nearest point of a bilinear face, restricted to the face.
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

BallMesh add_ball(SolidDraft& draft, const BallShape& shape) {
  BallMesh ball;
  ball.centre = shape.centre;
  BallCells cells(shape.across);
  BallGrid grid(draft, shape, cells);
  if (shape.edge) divide_at_pole(cells, grid, shape);
  std::vector<SolidMesh::Hexahedron> hexahedra;
  for (const BallCell& cell : cells.cells()) {
    SolidMesh::Hexahedron corners;
    for (std::size_t c = 0; c < 8; ++c) corners[c] = grid.node(cell[c]);
    hexahedra.push_back(corners);
  }
  hang_between(draft, grid, cells);
  for (SolidMesh::Hexahedron& corners : hexahedra) {
    turn_outside_out(draft.nodes, corners);
    draft.add_hexahedron(corners, SolidPart::tip, HexFormulation::solid);
  }
  for (const auto& face : cells.surface()) {
    std::array<int, 4> nodes;
    for (std::size_t c = 0; c < 4; ++c) nodes[c] = grid.node(face[c]);
    ball.faces.push_back(nodes);
  }
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
