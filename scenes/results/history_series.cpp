#include "scenes/results/history_series.hpp"

#include <algorithm>

#include "components/contact.hpp"
#include "components/observed.hpp"
#include "components/run_state.hpp"
#include "scenes/results/observables/result_rows.hpp"
#include "scenes/tools/bond_rules.hpp"
#include "scenes/tools/cell.hpp"

namespace pulvis {
namespace {

double share_of_narrow_contacts(const Observation& now) {
  if (!now.world.has<ContactQuality>()) return 0;
  const auto& quality = now.world.resource<ContactQuality>();
  return quality.force > 0 ? quality.narrow_force / quality.force : 0;
}

double overlap_of_particles(const Observation& now) {
  if (!now.world.has<ContactQuality>()) return 0;
  return now.world.resource<ContactQuality>().overlap / now.powder;
}

std::vector<double> corner_and_vectors(const Observation& now) {
  std::vector<double> numbers;
  with_cell_of(now.world, [&](const auto& cell) {
    const auto add = [&](const auto& v) { numbers.insert(numbers.end(), v.begin(), v.end()); };
    add(cell.corner_now());
    for (std::size_t k = 0; k < cell.vectors.n; ++k) add(cell.vectors.column(k));
  });
  return numbers;
}

}  // namespace

void add_energy_series(const Scene& scene, Observables& all) {
  const bool damped = std::ranges::any_of(scene.materials, &MaterialSpec::damped);
  const bool bonded = has_bonds(scene);
  all.add(
      [](const Observation& now) -> const Energies& { return now.energies; },
      {{"energy/kinetic", "J", "kinetic energy $E$", "of all nodes", &Energies::kinetic},
       {"energy/elastic", "J", "elastic energy $E$", "stored in the elements", &Energies::elastic},
       {"energy/plastic", "J", "plastic energy $E$", "dissipated by plastic flow",
        &Energies::plastic},
       {"energy/hourglass", "J", "hourglass energy $E$",
        "stored and dissipated in hourglass modes; zero with four points", &Energies::hourglass},
       {"energy/contact", "J", "contact energy $E$", "stored in the contact springs",
        &Energies::contact},
       {"energy/indentation", "J", "indentation energy $E$",
        "spent where surfaces indent; part of it comes back as surfaces come to fit each other",
        &Energies::indentation, scene.contact.hardness.has_value()},
       {"energy/friction", "J", "friction energy $E$", "dissipated by friction",
        &Energies::friction},
       {"energy/damping", "J", "contact damping energy $E$", "dissipated by contact damping",
        &Energies::damping},
       {"energy/bulk_damping", "J", "material damping energy $E$", "dissipated by material damping",
        &Energies::bulk_damping, damped},
       {"energy/bonds", "J", "bond energy $E$", "stored in the bonds", &Energies::bonds, bonded},
       {"energy/fracture", "J", "fracture energy $E$", "dissipated in breaking bonds",
        &Energies::fracture, bonded},
       {"energy/external", "J", "external work $E$",
        scene.cell ? "work of the cell" : "work of the tools", &Energies::external},
       {"energy/balance", "J", "balance error $E$",
        "sum of all energies minus the external work and the initial energy", &Energies::balance}});
}

void add_contact_series(const Scene& scene, Observables& all) {
  const bool space = scene.in_space();
  all.add(
      {{"contacts", "-", space ? "faces in contact" : "boundary edges in contact",
        space ? "faces in contact with another particle or a tool"
              : "boundary edges in contact with another particle or a tool",
        [](const Observation& now) {
          return static_cast<double>(now.world.resource<Totals>().touching);
        }},
       {"penetration", "-", space ? "penetration over face size" : "penetration over edge length",
        space ? "deepest so far, relative to the size of a face"
              : "deepest so far, relative to the boundary edge length",
        [](const Observation& now) { return now.world.resource<Totals>().worst_penetration; }},
       {"contact_overlap", "-",
        space ? "overlap over particle volume" : "overlap over particle area",
        space ? "volume in which surfaces overlap / volume of the particles"
              : "area in which outlines overlap / area of the particles",
        overlap_of_particles},
       {"narrow_contacts", "-",
        space ? "share of force on contacts narrower than two faces"
              : "share of force on contacts narrower than two edges",
        space ? "share of the contact force carried by contacts narrower than two faces"
              : "share of the contact force carried by contacts narrower than two boundary "
                "edges",
        share_of_narrow_contacts}});
}

void add_cell_fields(const Scene& scene, FrameFields& all) {
  if (!scene.cell) return;
  all.add({{{"cell", "m", "periodic cell $x$", "corner and vectors of the periodic cell",
             FieldPlace::list, scene.dimension},
            corner_and_vectors}});
}

Observables observables(const Scene& scene) {
  Observables all;
  add_tool_series(scene, all);
  add_die_series(scene, all);
  add_cell_series(scene, all);
  add_energy_series(scene, all);
  add_contact_series(scene, all);
  add_bond_series(scene, all);
  all.add({{"min_jacobian", "-", "smallest Jacobian $\\min J$", "smallest det F so far",
            [](const Observation& now) { return now.min_jacobian; }},
           {"dt", "s", "time step $\\Delta t$", "time step",
            [](const Observation& now) { return now.world.resource<Clock>().dt; }}});
  add_stress_series(scene, all);
  add_network_series(scene, all);
  add_density_series(scene, all);
  add_shear_series(scene, all);
  return all;
}

Observables momentum_of(const Scene& scene) {
  Observables all;
  add_momentum(scene, all);
  return all;
}

FrameFields frame_fields(const Scene& scene) {
  FrameFields all;
  add_cell_fields(scene, all);
  add_stress_fields(scene, all);
  add_network_fields(scene, all);
  add_density_fields(scene, all);
  add_bond_fields(scene, all);
  add_shear_fields(scene, all);
  return all;
}

std::vector<SeriesInfo> history_series(const Scene& scene) { return observables(scene).infos(); }

std::vector<SeriesInfo> momentum_series(const Scene& scene) { return momentum_of(scene).infos(); }

}  // namespace pulvis
