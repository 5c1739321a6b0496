#include "scenes/grains/voronoi.hpp"

#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

using Diagram = boost::polygon::voronoi_diagram<double>;
using Site = boost::polygon::point_data<std::int32_t>;

constexpr int guards = 16;
constexpr double guard_radius = 4;  // of the radius of the sites
constexpr double grid =
    1 << 28;  // integer grid cells in a guard radius: Boost's Voronoi uses integers

}  // namespace

VoronoiCells voronoi_cells(const std::vector<Vec2>& sites, double radius) {
  const double scale = grid / (guard_radius * radius);
  std::vector<Site> points;
  const auto add = [&](const Vec2& at) {
    points.emplace_back(static_cast<std::int32_t>(std::lround(scale * at.x())),
                        static_cast<std::int32_t>(std::lround(scale * at.y())));
  };
  for (const Vec2& site : sites) add(site);
  for (int i = 0; i < guards; ++i) {
    const double angle = 2 * std::numbers::pi * i / guards;
    add(guard_radius * radius * Vec2(portable::cos(angle), portable::sin(angle)));
  }
  Diagram diagram;
  boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);

  VoronoiCells result;
  result.cells.resize(sites.size());
  std::map<const Diagram::vertex_type*, int> numbers;
  const auto number_of = [&](const Diagram::vertex_type* vertex) {
    const auto [at, added] = numbers.try_emplace(vertex, static_cast<int>(result.vertices.size()));
    if (added) result.vertices.emplace_back(vertex->x() / scale, vertex->y() / scale);
    return at->second;
  };
  for (const auto& cell : diagram.cells()) {
    if (cell.source_index() >= sites.size()) continue;  // a guard site
    const Diagram::edge_type* edge = cell.incident_edge();
    do {
      result.cells[cell.source_index()].push_back(
          {number_of(edge->vertex0()), static_cast<int>(edge->twin()->cell()->source_index())});
      edge = edge->next();
    } while (edge != cell.incident_edge());
  }
  return result;
}

}  // namespace pulvis
