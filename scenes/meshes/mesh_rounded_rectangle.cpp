// Rounded rectangle: every arc has at least four equal edges; from there the edges grow by one ratio to the
// middle of the flat. Where an arc is long or its flat short, a side is divided evenly.
#include "scenes/meshes/mesh_rounded_rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/meshes/mesh_outlines.hpp"
#include "scenes/meshes/mesh_round.hpp"
#include "scenes/meshes/o_grid.hpp"
#include "scenes/outlines/outline.hpp"

namespace pulvis {
namespace {

constexpr int min_arc_edges = 4;

// Lengths first * ratio, first * ratio^2, ... to the middle, and back.
std::vector<double> growing(int edges, double first, double ratio) {
  std::vector<double> length;
  for (int e = 0; e < edges; ++e)
    length.push_back(first * portable::pow(ratio, std::min(e, edges - 1 - e) + 1));
  return length;
}

double sum(const std::vector<double>& lengths) {
  double total = 0;
  for (const double length : lengths) total += length;
  return total;
}

// The ratio that fills the flat; its sum increases with it.
double ratio_for(int edges, double first, double flat) {
  double low = 1, high = 2;
  while (sum(growing(edges, first, high)) < flat) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (sum(growing(edges, first, middle)) < flat ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// One side of `edges` edges, `on_arc` of them on its two half arcs, each `arc_edge` long; empty if there
// are too few.
std::vector<double> side(double flat, int edges, int on_arc, double arc_edge) {
  const int on_flat = edges - on_arc;
  if (on_flat < 0 || (on_flat == 0 && flat > arc_edge)) return {};
  if (flat <= std::max(on_flat, 1) * arc_edge)
    return std::vector<double>(static_cast<std::size_t>(edges), (flat + on_arc * arc_edge) / edges);
  std::vector<double> lengths = growing(on_flat, arc_edge, ratio_for(on_flat, arc_edge, flat));
  const auto half = static_cast<std::size_t>(on_arc / 2);
  lengths.insert(lengths.begin(), half, arc_edge);
  lengths.insert(lengths.end(), half, arc_edge);
  return lengths;
}

double growth_of(const std::vector<double>& columns, const std::vector<double>& rows) {
  double maximum = 1;
  const auto look = [&](double a, double b) { maximum = std::max({maximum, a / b, b / a}); };
  for (const auto* lengths : {&columns, &rows})
    for (std::size_t i = 1; i < lengths->size(); ++i) look((*lengths)[i - 1], (*lengths)[i]);
  look(columns.back(), rows.front());
  return maximum;
}

}  // namespace

RoundedSides share_edges(const RoundedRectangleOutline& rectangle, int boundary_edges) {
  const double flat[2] = {rectangle.width - 2 * rectangle.radius,
                          rectangle.height - 2 * rectangle.radius};
  const double arc = std::numbers::pi / 2 * rectangle.radius;
  const double mean = (2 * flat[0] + 2 * flat[1] + 4 * arc) / boundary_edges;
  const int on_arc = std::max(min_arc_edges, 2 * static_cast<int>(0.5 * arc / mean));
  RoundedSides best{{}, {}, std::numeric_limits<double>::max()};
  for (int columns = 1; columns < boundary_edges / 2; ++columns) {
    RoundedSides sides{side(flat[0], columns, on_arc, arc / on_arc),
                       side(flat[1], boundary_edges / 2 - columns, on_arc, arc / on_arc), 0};
    if (sides.columns.empty() || sides.rows.empty()) continue;
    sides.growth = growth_of(sides.columns, sides.rows);
    if (sides.growth < best.growth) best = std::move(sides);
  }
  return best;
}

int fewest_edges(const RoundedRectangleOutline& rectangle) {
  int edges = 4 * min_arc_edges;
  while (share_edges(rectangle, edges).growth > max_edge_growth) edges += 4;
  return edges;
}

void mesh_outline(const RoundedRectangleOutline& rectangle, const RoundedRectangleMesh& mesh,
                  double phase, Shape& shape) {
  const RoundedSides sides = share_edges(rectangle, mesh.boundary_edges);
  mesh_round({{rectangle.width, rectangle.height},
              rectangle.radius,
              stations_of(sides.columns),
              stations_of(sides.rows),
              mesh.rings},
             phase, shape);
}

}  // namespace pulvis
