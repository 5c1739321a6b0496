// Results of a run with bonds: a table of the cracks, figures of the summary. Empty for a scene without bonds. Series and
// fields: add_bond_series, add_bond_fields.
#pragma once

#include <optional>
#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/results/fragment_sizes.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// /cracks, one row for every contact point that broke, in order of breaking.
std::vector<TableInfo> bond_tables(const Scene& scene);
// Rows from `first` on. Empty without bonds.
std::vector<std::vector<double>> crack_rows(const World& world, std::int64_t first);

// From the last observation.
struct BondFindings {
  std::int64_t made = 0, broken = 0;  // contact points; each side of a pair has its own
  bool space = false;                 // three dimensions
  double crack_size = 0;              // m; in three dimensions m^2
  double fracture_energy = 0;         // J, dissipated by damage
  double crack_energy = 0;            // J, of the cracks, from their laws
  std::optional<double>
      shear_share;  // -, mode II share of the energy of broken bonds; empty if nothing broke
  std::optional<double> damage;  // -, broken length (area) over that of all bonds made at the start
  std::vector<FragmentSize> fragments;
  double largest_share = 0;  // -, of the area (volume)
};
std::optional<BondFindings> bond_findings(const World& world);

}  // namespace pulvis
