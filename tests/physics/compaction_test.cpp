// Compaction in a die: discs against the exact unit cell of the square packing, a block against uniaxial strain,
// the balance of forces.
#include <gtest/gtest.h>

#include "tests/helpers/unit_cell.hpp"

namespace pulvis {
namespace {

TEST(Compaction, UnitCellWith140Quads) {
  expect_unit_cell(compact("compaction/unit-cell.toml"), 0.05, 0.12);
}

TEST(Compaction, UnitCellWith560Quads) {
  expect_unit_cell(compact("compaction/unit-cell-fine.toml"), 0.03, 0.06);
}

// At least in proportion to the edges, until the reference itself is no better: half of them, a quarter of the squares.
TEST(Compaction, UnitCellConvergesWithTheMesh) {
  double before = 1e9;
  for (const char* edges : {"20", "40", "80"}) {
    const CompactionRun curve =
        compact("compaction/unit-cell.toml",
                {std::string("particle.disc.mesh.boundary_edges=") + edges,
                 std::string("particle.disc.mesh.rings=") + (edges[0] == '8' ? "2" : "1")});
    double sum = 0;
    for (const UnitCellReference& r : unit_cell_reference) {
      if (r.density < table_holds_from) continue;
      sum += std::pow(at(curve.density, curve.lateral, r.density) / r.lateral - 1, 2);
      sum += std::pow(at(curve.density, curve.axial, r.density) / r.axial - 1, 2);
    }
    EXPECT_LT(sum, before / 4) << edges << " edges";
    before = sum;
  }
}

double rms_difference(const CompactionRun& a, const CompactionRun& b) {
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
  std::vector<CompactionRun> curves;
  for (const double turn : {0.0, 2.25, 4.5, 6.75})
    curves.push_back(
        compact("compaction/unit-cell.toml",
                {phase(turn), "stage.press.move.top.displacement=[\"0 mm\", \"-0.95 mm\"]",
                 "stage.press.duration=\"0.6 ms\""}));
  CompactionRun mean;
  for (double rd = 0.80; rd <= 0.8601; rd += 0.002) {
    mean.density.push_back(rd);
    double sum = 0;
    for (const CompactionRun& c : curves) sum += at(c.density, c.axial, rd);
    mean.axial.push_back(sum / static_cast<double>(curves.size()));
  }
  double square = 0;
  for (const CompactionRun& c : curves) square += std::pow(rms_difference(c, mean), 2);
  EXPECT_LT(std::sqrt(square / static_cast<double>(curves.size())), 0.03);
}

// A frictionless matrix follows the unit cell until it buckles.
TEST(Compaction, FrictionlessMatrixFollowsTheUnitCell) {
  const std::vector<std::string> frictionless{
      "contact.friction=0", "material.316L.hardening_modulus=\"0 Pa\"",
      "stage.press.move.top.displacement=[\"0 mm\", \"-2.5 mm\"]", "stage.press.duration=\"6 ms\""};
  const CompactionRun matrix = compact("compaction/regular-25.toml", frictionless);
  const CompactionRun cell = compact("compaction/unit-cell.toml");
  for (const double rd : {0.80, 0.805, 0.81, 0.82})
    EXPECT_NEAR(at(matrix.density, matrix.axial, rd) / at(cell.density, cell.axial, rd), 1, 0.03)
        << rd;
}

double vertical_force(const Experiment& e) {  // of the tools, on the compact
  double sum = 0;
  for (const char* tool : {"left", "right", "bottom", "top"})
    sum -= e.value(std::string("tool/") + tool + "/force_y");
  return sum;
}

// What the punch gives and neither the bottom nor the friction of the walls takes changes the momentum of the compact:
// Newton's second law, in every step that is looked at.
TEST(Compaction, TheToolsForcesChangeTheMomentumOfTheCompact) {
  Experiment e(
      "compaction/regular-25.toml",
      {"stage.press.duration=\"1 ms\"", "stage.press.move.top.displacement=[\"0 mm\", \"-2 mm\"]"});
  for (int look = 1; look <= 20; ++look) {
    e.simulation.run_until(0.045e-3 * look);
    e.simulation.observe();
    e.results.sample();
    const Clock& clock = e.simulation.clock();
    const double dt = 0.5 * (clock.dt_before + clock.dt), top = e.value("tool/top/force_y");
    const double force = vertical_force(e), before = e.results.momentum()[1];
    e.simulation.move();
    EXPECT_NEAR(e.results.momentum()[1] - before, force * dt, 1e-9 * top * dt) << look;
    for (const char* wall : {"tool/left/force_", "tool/right/force_"})
      EXPECT_LE(std::abs(e.value(wall + std::string("y"))),
                0.1 * std::abs(e.value(wall + std::string("x"))) * (1 + 1e-9));
  }
}

// ---- a block that fills its die: uniaxial strain ------------------------------------------------------
struct BlockState {
  double strain[2], stress[2];  // lateral, axial: logarithmic, Pa; shortening and compression > 0
};

BlockState state_of_block(Experiment& e) {
  const auto& x = e.simulation.world().column<Position<TwoD>>();
  double low[2] = {1, 1}, high[2] = {-1, -1};
  for (std::size_t n = 0; n < x.table.rows; ++n)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], x.lanes()[2 * n + k][0]);
      high[k] = std::max(high[k], x.lanes()[2 * n + k][0]);
    }
  const double size[2] = {high[0] - low[0], high[1] - low[1]};
  const auto pressure = [&](const char* one, const char* other, double length) {
    return 0.5 * (e.value(one) - e.value(other)) / (length * e.scene.thickness);
  };
  return {{-std::log(size[0] / 10e-3), -std::log(size[1] / 10e-3)},
          {pressure("tool/right/force_x", "tool/left/force_x", size[1]),
           pressure("tool/top/force_y", "tool/bottom/force_y", size[0])}};
}

constexpr double block_bulk = 200e9 / (3 * (1 - 2 * 0.3)), block_shear = 200e9 / (2 * (1 + 0.3));

// Hooke in plane strain, for both stresses.
void expect_elastic(const BlockState& from, const BlockState& to) {
  constexpr double M = block_bulk + 4 * block_shear / 3, lambda = block_bulk - 2 * block_shear / 3;
  for (const int k : {0, 1}) {
    const double wanted =
        M * (to.strain[k] - from.strain[k]) + lambda * (to.strain[1 - k] - from.strain[1 - k]);
    EXPECT_NEAR(to.stress[k] - from.stress[k], wanted,
                2e-3 * std::abs(to.stress[1] - from.stress[1]));
  }
}

// The stress across the plane is what the mean stress of the change of volume leaves.
double mises(const BlockState& s) {
  const double x = s.stress[0], y = s.stress[1];
  const double z = 3 * block_bulk * (s.strain[0] + s.strain[1]) - x - y;
  return std::sqrt(0.5 * ((x - y) * (x - y) + (y - z) * (y - z) + (z - x) * (z - x)));
}

// Pressed past its yield point and a third of the way back: by Hooke's law, at the yield stress, by Hooke's law again.
TEST(Compaction, ABlockThatFillsItsDieLoadsAndUnloadsByItsModuli) {
  const std::string text = R"(extends = "compaction/unit-cell.toml"
remove = ["particle.disc.diameter", "particle.disc.mesh"]
[[particle]]
name = "disc"
outline = "rectangle"
width = "10 mm"
height = "10 mm"
mesh = { columns = 4, rows = 4 }
[contact]
stiffness = 0.5
[[stage]]
name = "press"
duration = "0.3 ms"
[[stage.move]]
tool = "top"
displacement = ["0 mm", "-0.06 mm"]
[[stage]]
name = "release"
kind = "unload"
duration = "0.3 ms"
[[stage.move]]
tool = "top"
displacement = ["0 mm", "0.02 mm"]
)";
  Experiment e(own_scene(text));
  constexpr double yield = 240e6;
  std::vector<BlockState> states;
  e.run(120, [&] { states.push_back(state_of_block(e)); });
  int elastic = 0, plastic = 0;
  for (std::size_t i = 10; i <= 60; ++i) {  // the first are of less than 50 MPa: waves
    const double reached = mises(states[i]) / yield;
    if (reached < 0.99) {
      expect_elastic({}, states[i]);
      ++elastic;
    } else if (states[i].stress[1] > 340e6) {
      EXPECT_NEAR(reached, 1, 2e-3) << i;
      ++plastic;
    }
  }
  EXPECT_GT(elastic, 15);
  EXPECT_GT(plastic, 20);
  for (std::size_t i = 65; i <= 120; ++i) expect_elastic(states[60], states[i]);
  EXPECT_LT(mises(states.back()), 0.5 * yield);
}

}  // namespace
}  // namespace pulvis
