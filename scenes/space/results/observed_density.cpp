#include "scenes/space/results/observed_density.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/space/observed.hpp"
#include "engine/entry.hpp"
#include "scenes/space/tools/die_room.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double min_room = 0.5;  // of a cell, for it to count towards the extremes

DensityGrid::Profile profile_of(const ToolSpec& tool) {
  DensityGrid::Profile profile;
  if (tool.shape == ToolSpec::Shape::punch)
    for (const Vec2& p : tool.profile) profile.push_back({p.x(), p.y()});
  return profile;
}

DensityGrid density_grid(const Scene& scene) {
  DensityGrid grid;
  grid.cells = scene.output.density_cells3;
  grid.between = *die_room(scene);
  if (grid.between.kind == DieRoom::Kind::round)
    for (const auto& [end, side] : {std::pair{0, DieRoom::bottom}, {1, DieRoom::top}})
      entry(grid.bottom_top, end) = profile_of(entry(scene.space->tools, grid.between.tool[side]));
  return grid;
}

struct DensityCells {
  const DensityGrid& grid;
  double whole = 1;  // m^3, of a cell

  explicit DensityCells(const DensityGrid& of) : grid(of) {
    for (std::size_t k = 0; k < 3; ++k) whole *= (grid.high[k] - grid.low[k]) / grid.cells[k];
  }
  // A cell whose room is only round-off has no density.
  double density(double filled, double room) const {
    return room > 1e-9 * whole ? filled / room : unknown;
  }
  std::vector<double> all() const {
    std::vector<double> cells;
    for (std::size_t c = 0; c < grid.filled.size(); ++c)
      cells.push_back(density(grid.filled[c], grid.room[c]));
    return cells;
  }
  std::vector<double> layers() const {
    const std::size_t layer =
        static_cast<std::size_t>(grid.cells[0]) * static_cast<std::size_t>(grid.cells[1]);
    std::vector<double> along_z;
    for (std::size_t first = 0; first < grid.filled.size(); first += layer) {
      double filled = 0, room = 0;
      for (std::size_t c = first; c < first + layer; ++c) {
        filled += grid.filled[c];
        room += grid.room[c];
      }
      along_z.push_back(density(filled, room));
    }
    return along_z;
  }
  std::vector<double> lines(std::size_t axis) const {
    std::vector<double> at;
    for (int i = 0; i <= grid.cells[axis]; ++i)
      at.push_back(grid.low[axis] + (grid.high[axis] - grid.low[axis]) * i / grid.cells[axis]);
    return at;
  }
};

}  // namespace

bool has_grid_room(const Scene& scene) {
  const auto room = die_room(scene);
  return room && std::ranges::count(room->axis, 0.0) == 2;
}

void add_observed_density(World& world, const Scene& scene) {
  if (scene.output.density()) world.emplace<DensityGrid>(density_grid(scene));
}

std::vector<SeriesInfo> density_series(const Scene& scene) {
  if (!scene.output.density()) return {};
  return {{"density/compact", "-", "deformed particle volume / volume between the tools"},
          {"density/minimum", "-", "of the cells that lie at least half between the tools"},
          {"density/maximum", "-", "of the same cells"},
          {"density/deviation", "-", "standard deviation over the cells, weighted by volume"}};
}

std::vector<FieldInfo> density_fields(const World& world) {
  if (!world.has<DensityGrid>()) return {};
  const int along_x = world.resource<DensityGrid>().cells[0];
  return {{"local_density", "-",
           "of every cell; NaN outside the tools; rows along x, then y, layer by layer in z",
           FieldPlace::list, along_x},
          {"density_profile", "-", "of every layer of cells across z, from the bottom",
           FieldPlace::list, 1},
          {"density_grid/x", "m", "planes between the cells", FieldPlace::list, 1},
          {"density_grid/y", "m", "planes between the cells", FieldPlace::list, 1},
          {"density_grid/z", "m", "planes between the cells", FieldPlace::list, 1}};
}

void append_density_sample(const World& world, std::vector<double>& row) {
  if (!world.has<DensityGrid>()) return;
  const auto& grid = world.resource<DensityGrid>();
  const DensityCells view(grid);
  const std::vector<double> cells = view.all();
  double filled = 0, room = 0, minimum = unknown, maximum = unknown, squares = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    filled += grid.filled[c];
    room += grid.room[c];
    if (grid.room[c] < min_room * view.whole) continue;
    minimum = std::fmin(minimum, cells[c]);  // the other value if one is NaN
    maximum = std::fmax(maximum, cells[c]);
  }
  const double mean = filled / room;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (!std::isnan(cells[c])) squares += grid.room[c] * (cells[c] - mean) * (cells[c] - mean);
  row.insert(row.end(), {mean, minimum, maximum, std::sqrt(squares / room)});
}

void append_density_frame(const World& world, std::vector<std::vector<double>>& fields) {
  if (!world.has<DensityGrid>()) return;
  const DensityCells view(world.resource<DensityGrid>());
  fields.push_back(view.all());
  fields.push_back(view.layers());
  for (std::size_t k = 0; k < 3; ++k) fields.push_back(view.lines(k));
}

}  // namespace pulvis::space
