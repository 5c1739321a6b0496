#include "cli/report/report_cell.hpp"

#include <algorithm>
#include <cmath>

namespace pulvis {
namespace {

Point sum(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1]}; }
Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1]}; }

}  // namespace

ReportCell::ReportCell(const hdf5::File& file, const std::string& frame,
                       const std::vector<std::int32_t>& node_particle)
    : node_particle_(node_particle) {
  if (!file.contains(frame + "/cell") || node_particle.empty()) return;
  const std::vector<double> cell = file.read_doubles(frame + "/cell");
  corner_ = {cell.at(0), cell.at(1)};
  vectors_ = {{cell.at(2), cell.at(4), cell.at(3), cell.at(5)}};
  find_ways(file.read_doubles(frame + "/position"));
}

void ReportCell::find_ways(const std::vector<double>& positions) {
  const auto particles = static_cast<std::size_t>(*std::ranges::max_element(node_particle_)) + 1;
  std::vector<Point> centre(particles);
  std::vector<double> nodes(particles);
  for (std::size_t n = 0; n < node_particle_.size(); ++n) {
    const auto p = static_cast<std::size_t>(node_particle_[n]);
    centre[p] = sum(centre[p], {positions[2 * n], positions[2 * n + 1]});
    nodes[p] += 1;
  }
  const Tensor2 inverse = vectors_.inverse();
  for (std::size_t p = 0; p < particles; ++p) {
    const Point middle{centre[p][0] / nodes[p], centre[p][1] / nodes[p]};
    const Point at = inverse * difference(middle, corner_);
    way_.push_back(vectors_ * Point{-std::floor(at[0]), -std::floor(at[1])});
  }
}

std::vector<double> ReportCell::inside(std::vector<double> positions) const {
  if (here())
    for (std::size_t i = 0; i < positions.size(); ++i)
      positions[i] += way(node_particle_[i / 2])[i % 2];
  return positions;
}

Point ReportCell::other_end(const Point& from, const Point& through, const Point& other) const {
  if (!here()) return other;
  const Point there = difference(sum(through, through), from);
  const Point periods = vectors_.inverse() * difference(there, other);
  return sum(other, vectors_ * Point{std::round(periods[0]), std::round(periods[1])});
}

std::vector<double> ReportCell::numbers() const {
  const auto& h = vectors_.t;
  return {corner_[0], corner_[1], h[0], h[2], h[1], h[3]};
}

std::vector<Point> ReportCell::corners() const {
  std::vector<Point> all;
  if (!here()) return all;
  for (const Point& at : {Point{0, 0}, {1, 0}, {1, 1}, {0, 1}})
    all.push_back(sum(corner_, vectors_ * at));
  return all;
}

}  // namespace pulvis
