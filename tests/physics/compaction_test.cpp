// Compaction of discs against the exact unit cell of the square packing (facts: perfectly plastic,
// frictionless, plane strain, finite strain; axial +-3%, lateral +-10%).
#include <gtest/gtest.h>

#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

struct Curve {
  std::vector<double> density, axial, lateral;
};

Curve compact(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  Experiment e(scene, overrides);
  Curve c;
  e.run(300, [&] {
    c.density.push_back(e.value("relative_density"));
    c.axial.push_back(e.value("stress_ratio/axial"));
    c.lateral.push_back(e.value("stress_ratio/lateral"));
  });
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
  EXPECT_LT(e.results.kinetic_ratio(), 0.02);
  return c;
}

struct Reference {
  double density, axial, lateral;
};
constexpr Reference reference[] = {{0.80, 0.45, 0.10},
                                   {0.82, 0.62, 0.30},
                                   {0.85, 0.78, 0.47},
                                   {0.90, 1.10, 0.73},
                                   {0.95, 1.44, 1.00}};

void expect_reference(const Curve& curve, double axial, double lateral) {
  for (const Reference& r : reference) {
    EXPECT_NEAR(at(curve.density, curve.axial, r.density) / r.axial, 1, axial)
        << "RD " << r.density;
    if (r.density > 0.83) {
      EXPECT_NEAR(at(curve.density, curve.lateral, r.density) / r.lateral, 1, lateral)
          << "RD " << r.density;
    }
  }
}

TEST(Compaction, UnitCellWith140Quads) {
  expect_reference(compact("compaction/unit-cell.toml"), 0.05, 0.12);
}

TEST(Compaction, UnitCellWith560Quads) {
  expect_reference(compact("compaction/unit-cell-fine.toml"), 0.03, 0.06);
}

// The forces come nearer to the reference with every mesh.
TEST(Compaction, UnitCellConvergesWithTheMesh) {
  double before = 1e9;
  for (const char* edges : {"20", "40", "80"}) {
    const Curve curve =
        compact("compaction/unit-cell.toml",
                {std::string("particle.disc.mesh.boundary_edges=") + edges,
                 std::string("particle.disc.mesh.rings=") + (edges[0] == '8' ? "2" : "1")});
    double sum = 0;
    for (const Reference& r : reference) {
      sum += std::pow(at(curve.density, curve.lateral, r.density) / r.lateral - 1, 2);
      sum += std::pow(at(curve.density, curve.axial, r.density) / r.axial - 1, 2);
    }
    EXPECT_LT(sum, before) << edges << " edges";
    before = sum;
  }
}

double rms_difference(const Curve& a, const Curve& b) {
  double sum = 0;
  int count = 0;
  for (double rd = 0.80; rd <= 0.8601; rd += 0.002, ++count) {
    const double d = at(a.density, a.axial, rd) / at(b.density, b.axial, rd) - 1;
    sum += d * d;
  }
  return std::sqrt(sum / count);
}

std::string phase(double degrees) {
  return "particle.disc.mesh.phase=\"" + std::to_string(degrees) + " deg\"";
}

// Turning the mesh inside the outline must not change the force. Asserted about the mean of the turns
// for one cell; half an edge is the worst turn that there is.
TEST(Compaction, UnitCellDoesNotDependOnWhereTheNodesLie) {
  std::vector<Curve> curves;
  for (const double turn : {0.0, 2.25, 4.5, 6.75})
    curves.push_back(
        compact("compaction/unit-cell.toml",
                {phase(turn), "stage.press.move.top.displacement=[\"0 mm\", \"-0.95 mm\"]",
                 "stage.press.duration=\"0.6 ms\""}));
  Curve mean;
  for (double rd = 0.80; rd <= 0.8601; rd += 0.002) {
    mean.density.push_back(rd);
    double sum = 0;
    for (const Curve& c : curves) sum += at(c.density, c.axial, rd);
    mean.axial.push_back(sum / static_cast<double>(curves.size()));
  }
  double square = 0;
  for (const Curve& c : curves) square += std::pow(rms_difference(c, mean), 2);
  EXPECT_LT(std::sqrt(square / static_cast<double>(curves.size())), 0.03);
}

// A frictionless matrix follows the unit cell until it buckles.
TEST(Compaction, FrictionlessMatrixFollowsTheUnitCell) {
  const std::vector<std::string> frictionless{
      "contact.friction=0", "material.316L.hardening_modulus=\"0 Pa\"",
      "stage.press.move.top.displacement=[\"0 mm\", \"-2.5 mm\"]", "stage.press.duration=\"6 ms\""};
  const Curve matrix = compact("compaction/regular-25.toml", frictionless);
  const Curve cell = compact("compaction/unit-cell.toml");
  for (const double rd : {0.80, 0.805, 0.81, 0.82})
    EXPECT_NEAR(at(matrix.density, matrix.axial, rd) / at(cell.density, cell.axial, rd), 1, 0.03)
        << rd;
}

TEST(Compaction, TopForceExceedsBottomForceByTheWallFriction) {
  Experiment e(
      "compaction/regular-25.toml",
      {"stage.press.duration=\"1 ms\"", "stage.press.move.top.displacement=[\"0 mm\", \"-2 mm\"]"});
  double wall = 0, difference = 0,
         top = 0;  // means over the second half: waves run through the compact
  e.run(200, [&] {
    if (e.simulation.clock().time < 0.5e-3) return;
    wall += (e.value("tool/left/force_y") + e.value("tool/right/force_y")) / 100;
    difference += (e.value("tool/top/force_y") + e.value("tool/bottom/force_y")) / 100;
    top += e.value("tool/top/force_y") / 100;
  });
  EXPECT_GT(difference, 0.01 * top);
  // Balance of the compact: what the walls carry is what the bottom lacks, but for the change of its
  // momentum (25 discs of 0.63 g, on average half as fast as the punch, whose 2.2 m/s come and go within
  // the 0.5 ms: 35 N).
  EXPECT_NEAR(difference, -wall, 40);
  EXPECT_LE(std::abs(e.value("tool/left/force_y")),
            0.1 * std::abs(e.value("tool/left/force_x")) * (1 + 1e-9));
}

}  // namespace
}  // namespace pulvis
