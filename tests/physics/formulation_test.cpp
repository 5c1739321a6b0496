// Formulations of the elements beside each other: bending, conservation and objectivity of one point; the
// unit cell with four, and with the standard element, which locks. (One point is the default that the other
// tests of scenes run with.)
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "components/body.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/free_bar.hpp"
#include "tests/helpers/unit_cell.hpp"

namespace pulvis {
namespace {

const std::string one_point = "element.formulation=one-point";

TEST(OnePoint, AllocatesNoColumnsOfOtherFormulations) {
  Experiment plain("compaction/unit-cell.toml", {"element.formulation=four-point"});
  Experiment one("compaction/unit-cell.toml", {one_point});
  World& w = one.simulation.world();
  EXPECT_FALSE((w.has<DeviatoricStress<TwoD, 4>>()));
  EXPECT_FALSE((w.has<CpInverse<TwoD, 4>>()));
  EXPECT_FALSE(w.has<PlasticStrain<4>>());
  EXPECT_FALSE(plain.simulation.world().has<HourglassStress>());
  EXPECT_FALSE(plain.simulation.world().has<PlasticHourglass<TwoD>>());
  EXPECT_FALSE((plain.simulation.world().has<DeviatoricStress<TwoD, 1>>()));
}

TEST(OnePoint, ForcesOfATurnedBodyAreTheTurnedForces) {
  std::vector<double> forces[2];
  const double c = std::cos(2.1), s = std::sin(2.1);
  for (int turned = 0; turned < 2; ++turned) {
    Experiment e("basic/spinning-disc.toml", {one_point});
    auto& x = e.simulation.world().column<Position<TwoD>>();
    for (std::size_t n = 0; n < x.table.rows; ++n) {
      const double u = x.lanes()[2 * n][0], v = x.lanes()[2 * n + 1][0];
      const double p = u * 1.02 + 0.01 * v + 3 * u * v, q = 0.97 * v - 2 * u * u;
      x.lanes()[2 * n][0] = turned != 0 ? c * p - s * q : p;
      x.lanes()[2 * n + 1][0] = turned != 0 ? s * p + c * q : q;
    }
    e.simulation.observe();
    e.results.sample();
    EXPECT_GT(e.results.energies().hourglass, 1e-3 * e.results.energies().elastic);
    const auto& f = e.column<InternalForce<TwoD>>();
    for (std::size_t n = 0; n < f.table.rows; ++n) {
      const double fx = const_cast<Column<InternalForce<TwoD>>&>(f).lanes()[2 * n][0];
      const double fy = const_cast<Column<InternalForce<TwoD>>&>(f).lanes()[2 * n + 1][0];
      forces[turned].push_back(turned != 0 ? c * fx + s * fy : fx);
      forces[turned].push_back(turned != 0 ? -s * fx + c * fy : fy);
    }
  }
  double largest = 0;
  for (const double v : forces[0]) largest = std::max(largest, std::abs(v));
  for (std::size_t i = 0; i < forces[0].size(); ++i)
    EXPECT_NEAR(forces[1][i], forces[0][i], 1e-9 * largest);
}

// ---- a free elastic beam in its first mode: one element thick, so that bending is all hourglassing ----
struct Beam {
  double frequency = 0;  // rad/s
  double exact = 0;      // Euler-Bernoulli, plane strain
  double balance = 0;    // worst error of the energy balance
  double hourglass = 0;  // largest share of the first energy
  double drift = 0;      // momentum across, over its absolute sum
};

constexpr double beam_length = 30e-3, beam_height = 1e-3;

Beam vibrate(const std::string& formulation, double nu) {
  const Scene scene =
      load_scene_text(FreeBar{formulation, 30, 1, nu, "", "500 us"}.text(), "beam.toml").scene;
  Simulation simulation(scene);
  World& w = simulation.world();
  Results results(scene, w);
  auto& x = w.column<Position<TwoD>>();
  auto& v = w.column<Velocity<TwoD>>();
  const std::vector<double> area = w.resource<Bodies>().shapes[0].nodal_area;
  const auto momentum = [&] {
    std::array<double, 2> sum{};
    for (std::size_t n = 0; n < area.size(); ++n) {
      sum[0] += area[n] * v.lanes()[2 * n + 1][0];
      sum[1] += area[n] * std::abs(v.lanes()[2 * n + 1][0]);
    }
    return sum;
  };
  for (std::size_t n = 0; n < area.size(); ++n)
    v.lanes()[2 * n + 1][0] = 0.1 * bending_mode(x.lanes()[2 * n][0] / beam_length);
  const double start = momentum()[0], size = momentum()[1];

  Beam beam;
  const double rigidity = 200e9 / (1 - nu * nu) * beam_height * beam_height / 12;
  beam.exact =
      bending_root * bending_root / (beam_length * beam_length) * std::sqrt(rigidity / 7850);
  double before = 0, first = 0, when = 0;
  std::vector<double> crossings;
  while (crossings.size() < 5 && !simulation.finished()) {
    simulation.observe();
    results.sample();
    const Energies& e = results.energies();
    if (first == 0) first = e.kinetic;
    beam.balance = std::max(beam.balance, std::abs(e.balance) / first);
    beam.hourglass = std::max(beam.hourglass, e.hourglass / first);
    const double end = x.lanes()[1][0] + beam_height / 2;  // a corner: rises first
    if (before * end < 0)
      crossings.push_back(when + (simulation.clock().time - when) * before / (before - end));
    before = end;
    when = simulation.clock().time;
    simulation.move();
  }
  if (crossings.size() == 5) beam.frequency = 4 * std::numbers::pi / (crossings[4] - crossings[0]);
  beam.drift = std::abs(momentum()[0] - start) / size;
  return beam;
}

// Shear and rotary inertia lower the frequency of this slender beam by 0.6%, 30 elements to a mode by less.
TEST(OnePoint, BeamOneElementThickVibratesLikeABeam) {
  const Beam beam = vibrate("one-point", 0.3);
  EXPECT_NEAR(beam.frequency / beam.exact, 1, 0.015);
  EXPECT_GT(beam.hourglass, 0.9);  // that is where bending is stored
  EXPECT_LT(beam.balance, 1e-3);
  EXPECT_LT(beam.drift, 1e-12);
}

TEST(OnePoint, BendingDoesNotLockWithoutCompressibility) {
  const Beam beam = vibrate("one-point", 0.4999);
  EXPECT_NEAR(beam.frequency / beam.exact, 1, 0.015);
}

TEST(Standard, BeamOfNearlyIncompressibleElementsLocks) {
  const Beam beam = vibrate("standard", 0.49);
  EXPECT_GT(beam.frequency / beam.exact, 3);
}

// ---- compaction ---------------------------------------------------------------------------------------
TEST(OnePoint, UnitCellStoresAndSpendsLittleInHourglassModes) {
  for (const auto& [scene, share] :
       {std::pair{"compaction/unit-cell.toml", 0.05}, {"compaction/unit-cell-fine.toml", 0.03}}) {
    const CompactionRun curve = compact(scene, {one_point});
    expect_unit_cell(curve, 0.05, 0.12);
    EXPECT_LT(curve.hourglass, share) << scene;
  }
}

TEST(FourPoint, UnitCellWith140Quads) {
  const CompactionRun curve =
      compact("compaction/unit-cell.toml", {"element.formulation=four-point"});
  expect_unit_cell(curve, 0.05, 0.12);
  EXPECT_EQ(curve.hourglass, 0);
}

TEST(FourPoint, UnitCellWith560Quads) {
  expect_unit_cell(compact("compaction/unit-cell-fine.toml", {"element.formulation=four-point"}),
                   0.03, 0.06);
}

TEST(Standard, UnitCellLocks) {
  const CompactionRun curve =
      compact("compaction/unit-cell.toml", {"element.formulation=standard"});
  EXPECT_GT(at(curve.density, curve.axial, 0.95) / 1.44, 1.25);
}

}  // namespace
}  // namespace pulvis
