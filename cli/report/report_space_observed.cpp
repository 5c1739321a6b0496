#include "cli/report/report_space_observed.hpp"

#include <array>
#include <cmath>

#include "cli/report/report_encoding.hpp"

namespace pulvis {
namespace {

// Lines to draw, seven numbers each: centre to centre, or centre to the tool's contact point; normal force.
std::vector<float> space_network_lines(const hdf5::File& file, const std::string& frame,
                                       const ReportCell<ThreeD>& cell) {
  std::vector<float> lines;
  const std::vector<double> centre = file.read_doubles(frame + "/particle_centre");
  const auto point_of = [](const std::vector<double>& points, std::size_t number) {
    return Point3{points[3 * number], points[3 * number + 1], points[3 * number + 2]};
  };
  const auto add_point = [&](const Point3& point, const Point3& shift) {
    for (std::size_t k = 0; k < 3; ++k) lines.push_back(static_cast<float>(point[k] + shift[k]));
  };
  for (const char* name : {"/contacts", "/tool_contacts"}) {
    const std::string group = frame + name;
    const bool pairs = group == frame + "/contacts";
    const auto ids = file.read_integers(group + "/ids");
    const auto point = file.read_doubles(group + "/point");
    const auto force = file.read_doubles(group + "/normal_force");
    for (std::size_t i = 0; i < force.size(); ++i) {
      const Point3 from = point_of(centre, static_cast<std::size_t>(ids[2 * i]));
      const Point3 through = point_of(point, i), shift = cell.way(ids[2 * i]);
      add_point(from, shift);
      if (pairs)
        add_point(cell.other_end(from, through,
                                 point_of(centre, static_cast<std::size_t>(ids[2 * i + 1]))),
                  shift);
      else
        add_point(through, shift);
      lines.push_back(static_cast<float>(std::abs(force[i])));  // the width of the line
    }
  }
  return lines;
}

// A grid with more cells than is useful is shown as averages over `merged`^3 of them.
constexpr std::size_t most_cells_of_a_grid = 4096;

using GridLines = std::array<std::vector<double>, 3>;

std::size_t groups_of(std::size_t cells, std::size_t size) { return (cells + size - 1) / size; }

std::size_t merging(const GridLines& lines) {
  const auto count = [&](std::size_t merged) {
    std::size_t cells = 1;
    for (const auto& line : lines) cells *= groups_of(line.size() - 1, merged);
    return cells;
  };
  std::size_t merged = 1;
  while (count(merged) > most_cells_of_a_grid) ++merged;
  return merged;
}

std::vector<double> every_so_many(const std::vector<double>& lines, std::size_t merged) {
  std::vector<double> kept;
  for (std::size_t i = 0; i + 1 < lines.size(); i += merged) kept.push_back(lines[i]);
  kept.push_back(lines.back());
  return kept;
}

// Cells without a number are ignored.
std::vector<double> merged_cells(const std::vector<double>& cells, const GridLines& lines,
                                 std::size_t merged) {
  const std::size_t nx = lines[0].size() - 1, ny = lines[1].size() - 1;
  const std::size_t across = groups_of(nx, merged), deep = groups_of(ny, merged);
  std::vector<double> sum(across * deep * groups_of(lines[2].size() - 1, merged)),
      count(sum.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (!std::isfinite(cells[c])) continue;
    const std::size_t x = c % nx, y = c / nx % ny, z = c / nx / ny;
    const std::size_t group = (z / merged * deep + y / merged) * across + x / merged;
    sum[group] += cells[c];
    count[group] += 1;
  }
  for (std::size_t g = 0; g < sum.size(); ++g) sum[g] /= count[g];  // 0 / 0: no cell has a number
  return sum;
}

// Five digits; NaN and infinity become null.
nlohmann::ordered_json density_grid_of(const hdf5::File& file, const std::string& frame) {
  GridLines lines;
  for (std::size_t k = 0; k < 3; ++k)
    lines[k] = file.read_doubles(frame + "/density_grid/" + "xyz"[k]);
  const std::size_t merged = merging(lines);
  nlohmann::ordered_json grid{{"merged", merged}, {"cells", nlohmann::ordered_json::array()}};
  for (const double cell : merged_cells(file.read_doubles(frame + "/local_density"), lines, merged))
    grid["cells"].push_back(std::round(cell * 1e5) / 1e5);
  for (std::size_t k = 0; k < 3; ++k)
    grid[std::string(1, "xyz"[k])] = every_so_many(lines[k], merged);
  return grid;
}

}  // namespace

void add_space_observed(const hdf5::File& file, const std::string& frame, const std::string& prefix,
                        const ReportCell<ThreeD>& cell, nlohmann::ordered_json& entry,
                        std::vector<ReportSection>& sections) {
  if (file.contains(frame + "/local_density")) entry["grid"] = density_grid_of(file, frame);
  if (!file.contains(frame + "/contacts")) return;
  const std::vector<float> lines = space_network_lines(file, frame, cell);
  entry["network"] = {{"lines", lines.size() / 7},
                      {"unit", file.text_attribute(frame + "/contacts/normal_force", "unit")}};
  if (!lines.empty()) sections.push_back({prefix + "network", encoded(lines)});
}

}  // namespace pulvis
