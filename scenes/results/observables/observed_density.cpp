// output.density_cells: relative densities in the cells of a grid between the tools.
#include <cmath>
#include <limits>
#include <numeric>

#include "components/observed.hpp"
#include "components/space/observed.hpp"
#include "engine/entry.hpp"
#include "scenes/results/observables/result_rows.hpp"

namespace pulvis {
namespace {

constexpr double no_density = std::numeric_limits<double>::quiet_NaN();

struct DensityFigures {
  double mean = 0, minimum = no_density, maximum = no_density, deviation = 0;
};

// The grid of either dimension; cells are numbered along x first.
struct GridView {
  const std::vector<double>&filled, &room;  // m^2 or m^3, of every cell
  double cell = 0;                          // m^2 or m^3, of a cell without tools
  std::size_t layers = 1;                   // along the last axis
  double least_room = 0;                    // of a cell, for it to count towards the extremes

  // A cell whose room is only round-off has no density.
  double density(double in_it, double of_it) const {
    return of_it > 1e-9 * cell ? in_it / of_it : no_density;
  }
  std::vector<double> cells() const {
    std::vector<double> all;
    for (std::size_t c = 0; c < filled.size(); ++c) all.push_back(density(filled[c], room[c]));
    return all;
  }
  std::vector<double> profile() const {
    std::vector<double> all;
    const std::size_t layer = filled.size() / layers;
    for (std::size_t first = 0; first < filled.size(); first += layer) {
      double in_it = 0, of_it = 0;
      for (std::size_t c = first; c < first + layer; ++c) {
        in_it += filled[c];
        of_it += room[c];
      }
      all.push_back(density(in_it, of_it));
    }
    return all;
  }
  DensityFigures figures() const {
    const std::vector<double> all = cells();
    DensityFigures f;
    double in_all = 0, of_all = 0, squares = 0;
    for (std::size_t c = 0; c < all.size(); ++c) {
      in_all += filled[c];
      of_all += room[c];
      if (room[c] < least_room * cell) continue;
      f.minimum = std::fmin(f.minimum, all[c]);  // the other value if one is NaN
      f.maximum = std::fmax(f.maximum, all[c]);
    }
    f.mean = in_all / of_all;
    for (std::size_t c = 0; c < all.size(); ++c)
      if (!std::isnan(all[c])) squares += room[c] * (all[c] - f.mean) * (all[c] - f.mean);
    f.deviation = std::sqrt(squares / of_all);
    return f;
  }
};

GridView plane_grid(const World& world) {
  const auto& grid = world.resource<DensityGrid>();
  const double width = (grid.side[1] - grid.side[0]) / grid.columns;
  const double height = (grid.side[3] - grid.side[2]) / grid.rows;
  return {grid.filled, grid.room, width * height, static_cast<std::size_t>(grid.rows)};
}

GridView space_grid(const World& world) {
  const auto& grid = world.resource<space::DensityGrid>();
  double cell = 1;
  for (std::size_t k = 0; k < 3; ++k) cell *= (grid.high[k] - grid.low[k]) / grid.cells[k];
  return {grid.filled, grid.room, cell, static_cast<std::size_t>(grid.cells[2]), 0.5};
}

// m, lines between the columns (axis 0) or rows of the grid.
std::vector<double> plane_lines(const World& world, int axis) {
  const auto& grid = world.resource<DensityGrid>();
  const int cells = axis == 0 ? grid.columns : grid.rows;
  const double low = entry(grid.side, 2 * axis);
  const double size = (entry(grid.side, 2 * axis + 1) - low) / cells;
  std::vector<double> at;
  for (int i = 0; i <= cells; ++i) at.push_back(low + i * size);
  return at;
}

std::vector<double> space_planes(const World& world, int axis) {
  const auto& grid = world.resource<space::DensityGrid>();
  const double low = entry(grid.low, axis), high = entry(grid.high, axis);
  const int cells = entry(grid.cells, axis);
  std::vector<double> at;
  for (int i = 0; i <= cells; ++i) at.push_back(low + (high - low) * i / cells);
  return at;
}

// What differs between the dimensions.
struct GridWords {
  const char *compact, *extremes, *maximum, *deviation;
  const char *cells, *profile, *x, *y;
};

constexpr GridWords plane_grid_words{
    "deformed particle area / area between the tools' surfaces",
    "of the cells",
    "of the cells",
    "standard deviation over the cells, by their areas",
    "of every cell; NaN where a tool fills it; rows from the bottom",
    "of every row of cells, from the bottom",
    "lines between the columns",
    "lines between the rows"};
constexpr GridWords space_grid_words{
    "deformed particle volume / volume between the tools",
    "of the cells that lie at least half between the tools",
    "of the same cells",
    "standard deviation over the cells, weighted by volume",
    "of every cell; NaN outside the tools; rows along x, then y, layer by layer in z",
    "of every layer of cells across z, from the bottom",
    "planes between the cells",
    "planes between the cells"};

}  // namespace

void add_density_series(const Scene& scene, Observables& all) {
  if (!scene.output.density()) return;
  const auto grid = scene.in_space() ? space_grid : plane_grid;
  const GridWords& words = scene.in_space() ? space_grid_words : plane_grid_words;
  all.add([grid](const Observation& now) { return grid(now.world).figures(); },
          {{"density/compact", "-", "relative density of the compact $\\rho$", words.compact,
            &DensityFigures::mean},
           {"density/minimum", "-", "lowest local density $\\rho_\\min$", words.extremes,
            &DensityFigures::minimum},
           {"density/maximum", "-", "highest local density $\\rho_\\max$", words.maximum,
            &DensityFigures::maximum},
           {"density/deviation", "-", "standard deviation of local densities $s_\\rho$",
            words.deviation, &DensityFigures::deviation}});
}

void add_density_fields(const Scene& scene, FrameFields& all) {
  if (!scene.output.density()) return;
  const bool space = scene.in_space();
  const auto grid = space ? space_grid : plane_grid;
  const auto lines_of = space ? space_planes : plane_lines;
  const auto lines = [lines_of](int axis) {
    return [lines_of, axis](const Observation& now) { return lines_of(now.world, axis); };
  };
  const GridWords& words = space ? space_grid_words : plane_grid_words;
  const int columns = space ? scene.output.density_cells3[0] : scene.output.density_cells[0];
  constexpr auto list = FieldPlace::list;
  all.add({{{"local_density", "-", "local relative density $\\rho$", words.cells, list, columns},
            [grid](const Observation& now) { return grid(now.world).cells(); }},
           {{"density_profile", "-", "relative density $\\rho$", words.profile, list, 1},
            [grid](const Observation& now) { return grid(now.world).profile(); }},
           {{"density_grid/x", "m", "grid lines $x$", words.x, list, 1}, lines(0)},
           {{"density_grid/y", "m", "grid lines $y$", words.y, list, 1}, lines(1)},
           {{"density_grid/z", "m", "grid lines $z$", words.y, list, 1}, lines(2), space}});
}

}  // namespace pulvis
