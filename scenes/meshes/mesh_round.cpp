// Boundary nodes by arc length from the middle of one corner's arc to the next; the core is a rectangle
// with slightly bulging sides, inset from the arcs so that the time step is largest.
#include "scenes/meshes/mesh_round.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/meshes/contact_curve.hpp"
#include "scenes/meshes/o_grid.hpp"
#include "scenes/meshes/smooth_outline.hpp"
#include "systems/body/time_step_kernel.hpp"

namespace pulvis {
namespace {

constexpr double bulge = 0.15;  // of the core's sides; 0: straight, 1: like the outline

// Nodes of the core's rim: its corners are inset from the middles of the arcs, in both
// directions, by a share of the shorter half size between these middles.
std::vector<Point> core_rim(const RoundGrid& round, const std::vector<OutlinePoint>& outline,
                            double inset) {
  const double cut = round.radius * (1 - std::numbers::sqrt2 / 2);
  const Point middle{0.5 * round.size[0] - cut, 0.5 * round.size[1] - cut};  // of an arc
  const double inside = inset * std::min(middle[0], middle[1]);
  const Point corner{middle[0] - inside, middle[1] - inside};
  const Point corners[4] = {{-corner[0], -corner[1]},
                            {corner[0], -corner[1]},
                            {corner[0], corner[1]},
                            {-corner[0], corner[1]}};
  std::vector<Point> rim;
  for (std::size_t side = 0; side < 4; ++side) {
    const std::vector<double>& stations = side % 2 == 0 ? round.columns : round.rows;
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
      const Point straight =
          between(corners[side], corners[(side + 1) % 4], 0.5 * (stations[i] + 1));
      const Point& p = outline[rim.size()].at;
      rim.push_back(
          between(straight, {p[0] * corner[0] / middle[0], p[1] * corner[1] / middle[1]}, bulge));
    }
  }
  return rim;
}

// Highest squared frequency of the mesh up to a factor, for elements with a quarter of their mass at each
// corner; those on the outline (the first `boundary` quads) also have contact springs, k = 2, which keeps
// the ring thick enough for the stiffest contact in use.
double frequency_bound(const std::vector<Point>& nodes, const std::vector<Quad>& quads,
                       std::size_t boundary) {
  constexpr double bulk = 13.0 / 6, mu = 1, springs = 2;  // nu = 0.3
  double highest = 0;
  for (std::size_t e = 0; e < quads.size(); ++e) {
    const auto at = [&](std::size_t k) {
      return nodes[static_cast<std::size_t>(quads[e][k].value)];
    };
    const auto map = kernels::quad_map(at(0)[0], at(0)[1], at(1)[0], at(1)[1], at(2)[0], at(2)[1],
                                       at(3)[0], at(3)[1]);
    const auto a = kernels::map_gradient(map, 0, 0);
    double bound = kernels::frequency_bound(kernels::mode_spread(a, {1, 0, 1}), bulk, mu, 1.0, 0.0);
    if (e < boundary) {
      const double slope =
          portable::hypot(at(1)[0] - at(0)[0], at(1)[1] - at(0)[1]) / (4 * determinant(a));
      bound += 2 * springs * bulk * slope * slope;
    }
    highest = std::max(highest, bound);
  }
  return highest;
}

// A large core leaves thin rings, a small one narrow elements at its corners. Sharp corners need a small
// inset: below 0.05 the steps are finer.
std::vector<double> insets() {
  std::vector<double> list;
  for (int i = 0; i <= 40; ++i) list.push_back(1 - (0.55 + 0.01 * i));
  while (list.back() > 1e-4) list.push_back(0.9 * list.back());
  return list;
}

double mean_edge(const std::vector<Point>& outline) {
  double perimeter = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point& a = outline[i];
    const Point& b = outline[(i + 1) % outline.size()];
    perimeter += portable::hypot(b[0] - a[0], b[1] - a[1]);
  }
  return perimeter / static_cast<double>(outline.size());
}

// Rings as thick as their edges are long, and inside them the transition, 0.8 times as thick as the core's
// edges are long: a core that starts deeper is coarse where the material flows, one that starts further
// out has flat transition quads.
std::vector<Point> coarse_nodes(const RoundGrid& round, const OGrid& grid,
                                const std::vector<OutlinePoint>& points,
                                const std::vector<Point>& outline) {
  constexpr double transition = 0.8 * 3;  // edges of the outline
  const double depth = round.rings + transition;
  const double inset = depth * mean_edge(outline) / (0.5 * std::min(round.size[0], round.size[1]));
  std::vector<double> shares;
  for (int r = 0; r <= round.rings; ++r) shares.push_back(1 - r / depth);
  shares.push_back(0.5 * shares.back());
  return nodes_of(grid, outline, core_rim(round, points, std::min(inset, 0.6)), shares,
                  round.columns, round.rows);
}

std::vector<Point> best_nodes(const RoundGrid& round, const OGrid& grid,
                              const std::vector<OutlinePoint>& points,
                              const std::vector<Point>& outline) {
  if (round.coarse_core) return coarse_nodes(round, grid, points, outline);
  const std::vector<double> shares = ring_shares(round.rings, round.ring_refinement);
  if (round.rings == 0) return nodes_of(grid, outline, outline, shares, round.columns, round.rows);
  const std::vector<Quad> quads = quads_of(grid);
  std::vector<Point> best;
  double minimum = std::numeric_limits<double>::max();
  for (const double inset : insets()) {
    std::vector<Point> nodes =
        nodes_of(grid, outline, core_rim(round, points, inset), shares, round.columns, round.rows);
    const double bound = frequency_bound(nodes, quads, outline.size());
    if (bound >= minimum) continue;
    minimum = bound;
    best = std::move(nodes);
  }
  return best;
}

}  // namespace

Point turned(const Point& p, double angle) {
  const double c = portable::cos(angle), s = portable::sin(angle);
  return {c * p[0] - s * p[1], s * p[0] + c * p[1]};
}

void mesh_round(const RoundGrid& round, double phase, Shape& shape) {
  const int stride = round.coarse_core ? 3 : 1;
  const OGrid grid{(static_cast<int>(round.columns.size()) - 1) / stride,
                   (static_cast<int>(round.rows.size()) - 1) / stride, round.rings,
                   round.coarse_core};
  const std::vector<OutlinePoint> points =
      rounded_points(round.size, round.radius, round.columns, round.rows);
  const SmoothOutline outline = smooth_outline(points, shape.area, round.short_waves);
  for (const Point& p : best_nodes(round, grid, points, outline.nodes))
    shape.nodes.push_back(turned(p, phase));
  shape.quads = quads_of(grid);
  shape.boundary_nodes = grid.around();
  close_curve(shape, {outline.c, round.short_waves});
}

}  // namespace pulvis
