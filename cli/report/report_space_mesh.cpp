#include "cli/report/report_space_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "cli/report/report_tetrahedra.hpp"

namespace pulvis {
namespace {

using Vec3 = Eigen::Vector3d;
using Side = std::array<std::int32_t, 4>;

Side nodes_of(std::span<const std::int32_t> hexahedra, std::int32_t side) {
  Side nodes{};
  const auto first = 8 * static_cast<std::size_t>(side / 6);
  const auto& corners = sides_of_hexahedron[static_cast<std::size_t>(side % 6)];
  for (std::size_t k = 0; k < 4; ++k) nodes[k] = hexahedra[first + corners[k]];
  return nodes;
}

Vec3 at(std::span<const double> xyz, std::int32_t node) {
  return Vec3::Map(&xyz[3 * static_cast<std::size_t>(node)]);
}

Vec3 mean_of(std::span<const double> xyz, std::span<const std::int32_t> nodes) {
  Vec3 sum = Vec3::Zero();
  for (const auto node : nodes) sum += at(xyz, node);
  return sum / static_cast<double>(nodes.size());
}

// The indices of all items that have a particle, grouped by particle.
std::map<std::int32_t, std::vector<std::int32_t>> grouped(std::span<const std::int32_t> numbers,
                                                          const SpaceMesh& mesh,
                                                          std::int32_t numbers_a_cell) {
  std::map<std::int32_t, std::vector<std::int32_t>> groups;
  for (const auto number : numbers)
    groups[mesh.cell_particle[static_cast<std::size_t>(number / numbers_a_cell)]].push_back(number);
  return groups;
}

}  // namespace

std::vector<std::int32_t> outer_sides(std::span<const std::int32_t> hexahedra) {
  std::vector<std::pair<Side, std::int32_t>> seen;  // sorted nodes, side
  const auto count = static_cast<std::int32_t>(6 * hexahedra.size() / 8);
  seen.reserve(static_cast<std::size_t>(count));
  for (std::int32_t side = 0; side < count; ++side) {
    Side key = nodes_of(hexahedra, side);
    std::ranges::sort(key);
    seen.emplace_back(key, side);
  }
  std::ranges::sort(seen);
  std::vector<std::int32_t> alone;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const bool twin = (i > 0 && seen[i - 1].first == seen[i].first) ||
                      (i + 1 < seen.size() && seen[i + 1].first == seen[i].first);
    if (!twin) alone.push_back(seen[i].second);
  }
  std::ranges::sort(alone);
  return alone;
}

double hexahedron_volume(std::span<const double> xyz, std::span<const std::int32_t> corners) {
  double volume = 0;
  for_tetrahedra(xyz, corners, [&](const Tetrahedron& one) { volume += one.volume; });
  return volume;
}

DrawnSpace DrawnSpace::whole(const SpaceMesh& mesh) {
  DrawnSpace drawn;
  drawn.cells_ = mesh.hexahedra;
  drawn.surface_ = outer_sides(mesh.hexahedra);
  drawn.particles_ = mesh.cell_particle;
  drawn.nodes_.resize(mesh.nodes());
  drawn.first_.resize(mesh.nodes() + 1);
  std::iota(drawn.nodes_.begin(), drawn.nodes_.end(), 0);
  std::iota(drawn.first_.begin(), drawn.first_.end(), 0);
  for (std::size_t c = 0; c < mesh.cells(); ++c)
    drawn.shares_.push_back({static_cast<std::int32_t>(c), static_cast<std::int32_t>(c)});
  drawn.volume_.assign(mesh.cells(), 1.0);
  return drawn;
}

DrawnSpace DrawnSpace::pyramids(const SpaceMesh& mesh) {
  DrawnSpace drawn;
  const std::span hexahedra(mesh.hexahedra);
  for (std::size_t c = 0; c < mesh.cells(); ++c)
    drawn.volume_.push_back(hexahedron_volume(mesh.reference, hexahedra.subspan(8 * c, 8)));
  std::vector<std::int32_t> all(mesh.cells());
  std::iota(all.begin(), all.end(), 0);
  const auto cells = grouped(all, mesh, 1);
  for (const auto& [particle, sides] : grouped(outer_sides(mesh.hexahedra), mesh, 6))
    drawn.add_particle(mesh, sides, cells.at(particle));
  return drawn;
}

void DrawnSpace::add_node(std::span<const std::int32_t> mean_of_nodes) {
  nodes_.insert(nodes_.end(), mean_of_nodes.begin(), mean_of_nodes.end());
  first_.push_back(static_cast<std::int32_t>(nodes_.size()));
}

// A mesh cell counts for the pyramids of its own sides; an interior one for that in its direction from the centre.
void DrawnSpace::add_particle(const SpaceMesh& mesh, std::span<const std::int32_t> sides,
                              std::span<const std::int32_t> cells) {
  std::set<std::int32_t> outer;
  for (const auto side : sides)
    for (const auto node : nodes_of(mesh.hexahedra, side)) outer.insert(node);
  const std::vector<std::int32_t> outside(outer.begin(), outer.end());
  const Vec3 middle = mean_of(mesh.reference, outside);
  const auto tip = static_cast<std::int32_t>(node_count());
  const auto first = static_cast<std::int32_t>(cell_count());
  add_node(outside);
  std::map<std::int32_t, std::int32_t> number;
  for (const auto node : outside) {
    number[node] = static_cast<std::int32_t>(node_count());
    add_node({&node, 1});
  }
  std::vector<Vec3> direction;
  std::set<std::int32_t> at_surface;
  for (const auto side : sides) {
    at_surface.insert(side / 6);
    shares_.push_back({side / 6, static_cast<std::int32_t>(cell_count())});
    const Side corners = nodes_of(mesh.hexahedra, side);
    for (const std::size_t k : {0U, 3U, 2U, 1U}) cells_.push_back(number[corners[k]]);
    cells_.insert(cells_.end(), 4, tip);
    surface_.push_back(6 * static_cast<std::int32_t>(cell_count()));
    particles_.push_back(mesh.cell_particle[static_cast<std::size_t>(side / 6)]);
    direction.push_back((mean_of(mesh.reference, corners) - middle).normalized());
  }
  for (const auto cell : cells) {
    if (at_surface.contains(cell)) continue;
    const auto c = static_cast<std::size_t>(cell);
    const Vec3 to = mean_of(mesh.reference, std::span(mesh.hexahedra).subspan(8 * c, 8)) - middle;
    const auto nearest =
        std::ranges::max_element(direction, {}, [&](const Vec3& d) { return d.dot(to); });
    shares_.push_back({cell, first + static_cast<std::int32_t>(nearest - direction.begin())});
  }
}

std::vector<double> DrawnSpace::positions(std::span<const double> xyz) const {
  std::vector<double> means;
  means.reserve(3 * node_count());
  for (std::size_t k = 0; k < node_count(); ++k) {
    const auto from = static_cast<std::size_t>(first_[k]);
    const auto count = static_cast<std::size_t>(first_[k + 1]) - from;
    const Vec3 mean = mean_of(xyz, std::span(nodes_).subspan(from, count));
    means.insert(means.end(), mean.begin(), mean.end());
  }
  return means;
}

std::vector<double> DrawnSpace::values(std::span<const double> of_cells) const {
  std::vector<double> sum(cell_count(), 0.0), volume(cell_count(), 0.0);
  for (const Share& share : shares_) {
    const auto c = static_cast<std::size_t>(share.cell), to = static_cast<std::size_t>(share.drawn);
    sum[to] += volume_[c] * of_cells[c];
    volume[to] += volume_[c];
  }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= volume[k];
  return sum;
}

}  // namespace pulvis
