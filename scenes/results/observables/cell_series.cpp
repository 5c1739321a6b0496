// The periodic cell, or a die whose walls are driven likewise: its size, strain and stress, and energies per volume.
#include "components/cell.hpp"
#include "components/shape.hpp"
#include "engine/portable_math.hpp"
#include "scenes/results/observables/enclosure.hpp"
#include "scenes/results/observables/result_rows.hpp"
#include "scenes/tools/cell.hpp"

namespace pulvis {
namespace {

struct CellFigures {
  double width = 0, height = 0;
  const MixedControl* control = nullptr;
  double density = 0, stored = 0, dissipated = 0;
};

CellFigures with_energies(CellFigures f, const Observation& now, double area) {
  const Energies& e = now.energies;
  const double volume = area * now.world.resource<Bodies>().thickness;
  f.density = now.powder / area;
  f.stored = (e.elastic + e.hourglass + e.contact + e.bonds) / volume;
  f.dissipated =
      (e.plastic + e.indentation + e.friction + e.damping + e.bulk_damping + e.fracture) / volume;
  return f;
}

CellFigures figures_of_cell(const Observation& now) {
  const auto& cell = now.world.resource<PeriodicCell>();
  const auto& h = cell.vectors.t;
  return with_energies({portable::hypot(h[0], h[2]), portable::hypot(h[1], h[3]), &cell.control},
                       now, cell.area());
}

CellFigures figures_of_walls(const Observation& now, const DieCell& die) {
  const Vec2 size = size_of(now.world, die);
  return with_energies({size.x(), size.y(), &now.world.resource<DrivenWalls>().control}, now,
                       area_of(now.world, die));
}

std::vector<Observable<CellFigures>> rows_of(bool periodic) {
  const auto strain = [](MixedControl::Part part) {
    return [part](const CellFigures& f) { return f.control->strain[part]; };
  };
  const auto stress = [](MixedControl::Part part) {
    return [part](const CellFigures& f) { return f.control->stress[part]; };
  };
  const char* of_strain = "logarithmic: rate of deformation of the cell, integrated";
  const char* of_stress =
      "Cauchy, of the contact forces in the cell, or of the forces on the walls; tension > 0";
  return {
      {"relative_density", "-", "relative density $\\rho$",
       "undeformed particle area / area of the cell", &CellFigures::density, periodic},
      {"cell/width", "m", "width of the cell $w$",
       "length of its first vector, or between the walls", &CellFigures::width},
      {"cell/height", "m", "height of the cell $h$",
       "length of its second vector, or between the walls", &CellFigures::height},
      {"cell/strain_xx", "-", "strain of the cell $\\varepsilon_{xx}$", of_strain,
       strain(MixedControl::xx)},
      {"cell/strain_yy", "-", "strain of the cell $\\varepsilon_{yy}$", of_strain,
       strain(MixedControl::yy)},
      {"cell/strain_xy", "-", "strain of the cell $\\varepsilon_{xy}$", of_strain,
       strain(MixedControl::xy)},
      {"cell/rotation", "rad", "rotation of the cell $\\omega$", "spin of the cell, integrated",
       [](const CellFigures& f) { return f.control->rotation; }},
      {"cell/stress_xx", "Pa", "mean stress $\\sigma_{xx}$", of_stress, stress(MixedControl::xx)},
      {"cell/stress_yy", "Pa", "mean stress $\\sigma_{yy}$", of_stress, stress(MixedControl::yy)},
      {"cell/stress_xy", "Pa", "mean stress $\\sigma_{xy}$", of_stress, stress(MixedControl::xy)},
      {"cell/stored_energy", "J/m^3", "stored energy $u$",
       "in elements including their hourglass modes, contact springs and bonds, per current "
       "volume of the cell",
       &CellFigures::stored},
      {"cell/dissipated_energy", "J/m^3", "dissipated energy $d$",
       "by plastic flow, friction, damping and fracture so far, per the same volume",
       &CellFigures::dissipated}};
}

}  // namespace

void add_cell_series(const Scene& scene, Observables& all) {
  if (scene.cell)
    all.add(figures_of_cell, rows_of(true));
  else if (drives_walls(scene))
    all.add([die = die_cell(scene).value_or(DieCell{})](
                const Observation& now) { return figures_of_walls(now, die); },
            rows_of(false));
}

}  // namespace pulvis
