// The periodic cell, or a die whose walls are driven likewise: its size, strain and stress, and energies per volume.
#include <fmt/format.h>

#include <array>
#include <string>

#include "engine/portable_math.hpp"
#include "scenes/results/observables/enclosure.hpp"
#include "scenes/results/observables/result_rows.hpp"
#include "scenes/tools/cell.hpp"

namespace pulvis {
namespace {

struct CellFigures {
  std::array<double, 3> sides{};  // m
  const MixedControl* control = nullptr;
  double density = 0, stored = 0, dissipated = 0;
};

// `size`: m^2 or m^3.
CellFigures with_energies(CellFigures f, const Observation& now, double size, double thickness) {
  const Energies& e = now.energies;
  const double volume = size * thickness;
  f.density = now.powder / size;
  f.stored = (e.elastic + e.hourglass + e.contact + e.bonds) / volume;
  f.dissipated =
      (e.plastic + e.indentation + e.friction + e.damping + e.bulk_damping + e.fracture) / volume;
  return f;
}

CellFigures figures_of_cell(const Observation& now) {
  CellFigures found;
  with_cell_of(now.world, [&](const auto& cell) {
    found.control = &cell.control;
    for (std::size_t k = 0; k < cell.vectors.n; ++k) {
      double length = 0;
      for (const double part : cell.vectors.column(k)) length = portable::hypot(length, part);
      found.sides[k] = length;
    }
    found = with_energies(found, now, cell.size(), cell.thickness);
  });
  return found;
}

CellFigures figures_of_walls(const Observation& now) {
  const DrivenWalls& driven = now.world.resource<DrivenWalls>();
  CellFigures found{{}, &driven.control};
  double size = 1;
  for (std::size_t k = 0; k < driven.walls.size(); ++k) {
    const auto [low, high] = driven.walls[k];
    const int axis = static_cast<int>(k);
    found.sides[k] = tool_position(now.world, high, axis) - tool_position(now.world, low, axis);
    size *= found.sides[k];
  }
  return with_energies(found, now, size, driven.thickness);
}

Observable<CellFigures> side_row(const char* name, const char* symbol, const char* meaning,
                                 std::size_t axis) {
  return {std::string("cell/") + name, "m", fmt::format("{} of the cell ${}$", name, symbol),
          meaning, [axis](const CellFigures& f) { return f.sides[axis]; }};
}

// The components that a scene of this dimension has.
std::vector<std::size_t> parts_of(bool space) {
  if (!space) return {MixedControl::xx, MixedControl::yy, MixedControl::xy};
  return {0, 1, 2, 3, 4, 5};
}

void add_components(bool space, std::vector<Observable<CellFigures>>& rows) {
  for (const std::size_t part : parts_of(space)) {
    const char* name = tensor_part_names[part];
    rows.push_back({fmt::format("cell/strain_{}", name), "-",
                    fmt::format("strain of the cell $\\varepsilon_{{{}}}$", name),
                    "logarithmic: rate of deformation of the cell, integrated",
                    [part](const CellFigures& f) { return f.control->strain[part]; }});
  }
  const char* of_rotation = "spin of the cell, integrated";
  const auto rotation = [](std::size_t axis) {
    return [axis](const CellFigures& f) { return f.control->rotation[axis]; };
  };
  if (!space)
    rows.push_back(
        {"cell/rotation", "rad", "rotation of the cell $\\omega$", of_rotation, rotation(2)});
  for (std::size_t axis = 0; space && axis < 3; ++axis) {
    const char name = "xyz"[axis];
    rows.push_back({fmt::format("cell/rotation_{}", name), "rad",
                    fmt::format("rotation of the cell $\\omega_{}$", name), of_rotation,
                    rotation(axis)});
  }
  for (const std::size_t part : parts_of(space)) {
    const char* name = tensor_part_names[part];
    rows.push_back(
        {fmt::format("cell/stress_{}", name), "Pa",
         fmt::format("mean stress $\\sigma_{{{}}}$", name),
         "Cauchy, of the contact forces in the cell, or of the forces on the walls; tension > 0",
         [part](const CellFigures& f) { return f.control->stress[part]; }});
  }
}

std::vector<Observable<CellFigures>> rows_of(const Scene& scene) {
  const bool space = scene.in_space();
  std::vector<Observable<CellFigures>> rows{
      {"relative_density", "-", "relative density $\\rho$",
       space ? "undeformed particle volume / volume of the cell"
             : "undeformed particle area / area of the cell",
       &CellFigures::density, scene.cell.has_value()},
      side_row("width", "w", "length of its first vector, or between the walls", 0)};
  if (space)
    rows.push_back(side_row("depth", "d", "length of its second vector, or between the walls", 1));
  rows.push_back(side_row("height", "h",
                          space ? "length of its third vector, or between the walls"
                                : "length of its second vector, or between the walls",
                          space ? 2 : 1));
  add_components(space, rows);
  rows.push_back({"cell/stored_energy", "J/m^3", "stored energy $u$",
                  "in elements including their hourglass modes, contact springs and bonds, per "
                  "current volume of the cell",
                  &CellFigures::stored});
  rows.push_back({"cell/dissipated_energy", "J/m^3", "dissipated energy $d$",
                  "by plastic flow, friction, damping and fracture so far, per the same volume",
                  &CellFigures::dissipated});
  return rows;
}

}  // namespace

void add_cell_series(const Scene& scene, Observables& all) {
  if (scene.cell)
    all.add(figures_of_cell, rows_of(scene));
  else if (drives_walls(scene))
    all.add(figures_of_walls, rows_of(scene));
}

}  // namespace pulvis
