#include "scenes/lever/mesh/plan_mesh.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

constexpr double inside = 1e-7;  // -, how far outside [-1, 1] still counts as on the edge

// Points are shared with earlier grids only, so that only the boundary has to be searched.
int shared_point(PlanMesh& mesh, const Vec2& point, double tolerance, std::size_t earlier) {
  for (std::size_t i = 0; i < earlier; ++i)
    if ((mesh.points[i] - point).squaredNorm() < tolerance * tolerance) return static_cast<int>(i);
  mesh.points.push_back(point);
  return static_cast<int>(mesh.points.size()) - 1;
}

Vec2 blended(const std::array<Vec2, 4>& corners, double s, double t) {
  return (1 - s) * (1 - t) * corners[0] + s * (1 - t) * corners[1] + s * t * corners[2] +
         (1 - s) * t * corners[3];
}

std::optional<PlaceInQuad> place_in(const std::array<Vec2, 4>& x, const Vec2& point) {
  double xi = 0, eta = 0;
  for (int i = 0; i < 12; ++i) {
    const Vec2 at = blended(x, 0.5 * (1 + xi), 0.5 * (1 + eta));
    Eigen::Matrix2d jacobian;
    jacobian.col(0) = 0.25 * ((1 - eta) * (x[1] - x[0]) + (1 + eta) * (x[2] - x[3]));
    jacobian.col(1) = 0.25 * ((1 - xi) * (x[3] - x[0]) + (1 + xi) * (x[2] - x[1]));
    const Vec2 step = jacobian.inverse() * (point - at);
    xi += step.x();
    eta += step.y();
    if (!(std::abs(xi) < 10 && std::abs(eta) < 10)) return {};
    if (step.norm() < 1e-13) break;
  }
  if (std::abs(xi) > 1 + inside || std::abs(eta) > 1 + inside) return {};
  return PlaceInQuad{xi, eta};
}

// Quadratic shape functions for straight edges.
std::optional<std::array<double, 6>> weights_in_triangle(const std::array<Vec2, 3>& x,
                                                         const Vec2& point) {
  Eigen::Matrix2d edges;
  edges << x[1] - x[0], x[2] - x[0];
  const Vec2 s = edges.inverse() * (point - x[0]);
  const double a = 1 - s.x() - s.y(), b = s.x(), c = s.y();
  if (!(std::min({a, b, c}) >= -inside)) return {};
  return std::array<double, 6>{a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1),
                               4 * a * b,       4 * b * c,       4 * c * a};
}

template <std::size_t Count, class Corners>
std::vector<PlanShare> shares(const Corners& nodes, const std::array<double, Count>& weights) {
  std::vector<PlanShare> shares;
  for (std::size_t c = 0; c < Count; ++c) shares.push_back({nodes[c], weights[c]});
  return shares;
}

}  // namespace

void add_grid(PlanMesh& mesh, int along, int across, double tolerance,
              const std::function<Vec2(int i, int j)>& point) {
  const std::size_t earlier = mesh.points.size();
  std::vector<int> grid;
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i <= along; ++i) {
      const bool rim = i == 0 || j == 0 || i == along || j == across;
      grid.push_back(shared_point(mesh, point(i, j), tolerance, rim ? earlier : 0));
    }
  const auto at = [&](int i, int j) { return grid[static_cast<std::size_t>(j * (along + 1) + i)]; };
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < along; ++i)
      mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
}

void add_patch(PlanMesh& mesh, const std::array<Vec2, 4>& corners, const std::vector<double>& along,
               const std::vector<double>& across, double tolerance) {
  add_grid(mesh, static_cast<int>(along.size()) - 1, static_cast<int>(across.size()) - 1, tolerance,
           [&](int i, int j) {
             return blended(corners, along[static_cast<std::size_t>(i)],
                            across[static_cast<std::size_t>(j)]);
           });
}

std::vector<double> even_shares(int count) {
  std::vector<double> shares;
  for (int i = 0; i <= count; ++i) shares.push_back(static_cast<double>(i) / count);
  return shares;
}

namespace {

Vec2 turned(int side, const Vec2& x) {
  return side == 0   ? x
         : side == 1 ? Vec2(-x.y(), x.x())
         : side == 2 ? Vec2(-x.x(), -x.y())
                     : Vec2(x.y(), -x.x());
}

}  // namespace

Vec2 rim_of_disc(int side, int j, int across) {
  const double angle = 0.25 * std::numbers::pi * (2.0 * j / across - 1);
  return turned(side, {portable::cos(angle), portable::sin(angle)});
}

PlanMesh unit_disc(int across, const std::vector<double>& ring) {
  constexpr double core = 0.5;  // half-width; rim corners of 135 degrees keep the ring well shaped
  PlanMesh mesh;
  add_patch(mesh, {Vec2(-core, -core), Vec2(core, -core), Vec2(core, core), Vec2(-core, core)},
            even_shares(across), even_shares(across), 1e-6);
  for (int side = 0; side < 4; ++side)
    add_grid(mesh, static_cast<int>(ring.size()) - 1, across, 1e-6, [&](int i, int j) {
      const double t = ring[static_cast<std::size_t>(i)] / (1 - core);
      const Vec2 inner = turned(side, {core, core * (2.0 * j / across - 1)});
      return Vec2((1 - t) * inner + t * rim_of_disc(side, j, across));
    });
  return mesh;
}

std::array<double, 4> PlaceInQuad::weights() const {
  return {0.25 * (1 - xi) * (1 - eta), 0.25 * (1 + xi) * (1 - eta), 0.25 * (1 + xi) * (1 + eta),
          0.25 * (1 - xi) * (1 + eta)};
}

std::optional<std::vector<PlanShare>> locate(const PlanMesh& mesh, const Vec2& point) {
  const auto at = [&](int p) { return mesh.points[static_cast<std::size_t>(p)]; };
  for (const auto& q : mesh.quads) {
    const std::array<Vec2, 4> x{at(q[0]), at(q[1]), at(q[2]), at(q[3])};
    const double size = std::max((x[2] - x[0]).norm(), (x[3] - x[1]).norm());
    if ((point - x[0]).norm() > 2 * size) continue;
    if (const auto place = place_in(x, point)) return shares(q, place->weights());
  }
  for (const auto& t : mesh.triangles)
    if (const auto weights = weights_in_triangle({at(t[0]), at(t[1]), at(t[2])}, point))
      return shares(t, *weights);
  return {};
}

}  // namespace pulvis
