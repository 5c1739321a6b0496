#include "cli/report/report_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

namespace pulvis {
namespace {

double area_of(const PlaneMesh& mesh, std::size_t cell) {
  double twice = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto a = 2 * static_cast<std::size_t>(mesh.quads[4 * cell + k]);
    const auto b = 2 * static_cast<std::size_t>(mesh.quads[4 * cell + (k + 1) % 4]);
    twice += mesh.reference[a] * mesh.reference[b + 1] - mesh.reference[b] * mesh.reference[a + 1];
  }
  return std::abs(twice) / 2;
}

std::array<double, 2> middle_of(const PlaneMesh& mesh, std::span<const std::int32_t> nodes) {
  std::array<double, 2> sum{};
  for (const auto node : nodes)
    for (std::size_t k = 0; k < 2; ++k)
      sum[k] += mesh.reference[2 * static_cast<std::size_t>(node) + k] /
                static_cast<double>(nodes.size());
  return sum;
}

double length_of(const PlaneMesh& mesh, const std::vector<std::int32_t>& loop) {
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto a = 2 * static_cast<std::size_t>(loop[i]);
    const auto b = 2 * static_cast<std::size_t>(loop[(i + 1) % loop.size()]);
    length += std::hypot(mesh.reference[b] - mesh.reference[a],
                         mesh.reference[b + 1] - mesh.reference[a + 1]);
  }
  return length;
}

// The longest chain of edges that belong to only one quad: the outline of a particle.
std::vector<std::int32_t> outline_of(const PlaneMesh& mesh, std::span<const std::int32_t> cells) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> seen;
  std::map<std::int32_t, std::int32_t> next;
  const auto edge = [&](std::int32_t cell, std::size_t k) {
    const auto* quad = &mesh.quads[4 * static_cast<std::size_t>(cell)];
    return std::pair(quad[k], quad[(k + 1) % 4]);
  };
  for (const auto cell : cells)
    for (std::size_t k = 0; k < 4; ++k)
      ++seen[std::minmax({edge(cell, k).first, edge(cell, k).second})];
  for (const auto cell : cells)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [a, b] = edge(cell, k);
      if (seen[std::minmax({a, b})] == 1) next[a] = b;
    }
  std::vector<std::int32_t> longest;
  double maximum = -1;
  while (!next.empty()) {
    std::vector<std::int32_t> loop;
    for (auto at = next.begin(); at != next.end();) {
      loop.push_back(at->first);
      const auto to = at->second;
      next.erase(at);
      at = next.find(to);
    }
    if (const double length = length_of(mesh, loop); length > maximum) {
      maximum = length;
      longest = loop;
    }
  }
  return longest;
}

}  // namespace

DrawnMesh DrawnMesh::whole(const PlaneMesh& mesh) {
  DrawnMesh drawn;
  drawn.cells_ = mesh.quads;
  drawn.nodes_.resize(mesh.nodes());
  drawn.first_.resize(mesh.nodes() + 1);
  drawn.drawn_.resize(mesh.cells());
  std::iota(drawn.nodes_.begin(), drawn.nodes_.end(), 0);
  std::iota(drawn.first_.begin(), drawn.first_.end(), 0);
  std::iota(drawn.drawn_.begin(), drawn.drawn_.end(), 0);
  drawn.area_.assign(mesh.cells(), 1.0);
  return drawn;
}

DrawnMesh DrawnMesh::fans(const PlaneMesh& mesh, std::size_t sectors) {
  DrawnMesh drawn;
  drawn.drawn_.resize(mesh.cells());
  for (std::size_t c = 0; c < mesh.cells(); ++c) drawn.area_.push_back(area_of(mesh, c));
  std::map<std::int32_t, std::vector<std::int32_t>> cells_of;
  for (std::size_t c = 0; c < mesh.cells(); ++c)
    cells_of[mesh.cell_particle[c]].push_back(static_cast<std::int32_t>(c));
  for (const auto& [particle, cells] : cells_of) drawn.add_fan(mesh, cells, sectors);
  return drawn;
}

void DrawnMesh::add_node(std::span<const std::int32_t> mean_of) {
  nodes_.insert(nodes_.end(), mean_of.begin(), mean_of.end());
  first_.push_back(static_cast<std::int32_t>(nodes_.size()));
}

// A mesh cell contributes to the triangle that lies in its direction from the centre.
void DrawnMesh::add_fan(const PlaneMesh& mesh, std::span<const std::int32_t> cells,
                        std::size_t sectors) {
  const auto outline = outline_of(mesh, cells);
  const std::size_t points = std::min(sectors, outline.size());
  const auto centre = static_cast<std::int32_t>(node_count());
  const auto first = static_cast<std::int32_t>(cell_count());
  const auto middle = middle_of(mesh, outline);
  const auto direction = [&](std::array<double, 2> at) {
    return std::atan2(at[1] - middle[1], at[0] - middle[0]);
  };
  add_node(outline);
  std::vector<double> bisector;
  for (std::size_t i = 0; i < points; ++i) {
    const std::int32_t node = outline[i * outline.size() / points];
    const std::int32_t after = outline[(i + 1) % points * outline.size() / points];
    add_node({&node, 1});
    const auto a = centre + 1 + static_cast<std::int32_t>(i);
    const auto b = centre + 1 + static_cast<std::int32_t>((i + 1) % points);
    cells_.insert(cells_.end(), {centre, a, b, b});
    bisector.push_back(direction(middle_of(mesh, std::array{node, after})));
  }
  for (const auto cell : cells) {
    const auto at = direction(
        middle_of(mesh, std::span(mesh.quads).subspan(4 * static_cast<std::size_t>(cell), 4)));
    const auto apart = [&](double angle) {
      return std::abs(std::remainder(angle - at, 2 * std::numbers::pi));
    };
    const auto nearest = std::ranges::min_element(bisector, {}, apart) - bisector.begin();
    drawn_[static_cast<std::size_t>(cell)] = first + static_cast<std::int32_t>(nearest);
  }
}

std::vector<double> DrawnMesh::positions(std::span<const double> xy) const {
  std::vector<double> mean(2 * node_count(), 0.0);
  for (std::size_t k = 0; k < node_count(); ++k) {
    const double share = 1.0 / (first_[k + 1] - first_[k]);
    for (auto i = first_[k]; i < first_[k + 1]; ++i) {
      const auto node = 2 * static_cast<std::size_t>(nodes_[static_cast<std::size_t>(i)]);
      mean[2 * k] += share * xy[node];
      mean[2 * k + 1] += share * xy[node + 1];
    }
  }
  return mean;
}

std::vector<std::int32_t> DrawnMesh::particles(const PlaneMesh& mesh) const {
  std::vector<std::int32_t> numbers;
  for (std::size_t c = 0; c < cell_count(); ++c) {
    const auto corner = static_cast<std::size_t>(cells_[4 * c]);
    const std::int32_t node = nodes_[static_cast<std::size_t>(first_[corner])];
    numbers.push_back(mesh.node_particle[static_cast<std::size_t>(node)]);
  }
  return numbers;
}

std::vector<double> DrawnMesh::values(std::span<const double> of_cells) const {
  std::vector<double> sum(cell_count(), 0.0), area(cell_count(), 0.0);
  for (std::size_t c = 0; c < drawn_.size(); ++c) {
    const auto to = static_cast<std::size_t>(drawn_[c]);
    sum[to] += area_[c] * of_cells[c];
    area[to] += area_[c];
  }
  for (std::size_t k = 0; k < sum.size(); ++k)  // a thin triangle may contain no cell
    sum[k] = area[k] > 0 ? sum[k] / area[k] : std::numeric_limits<double>::quiet_NaN();
  return sum;
}

}  // namespace pulvis
