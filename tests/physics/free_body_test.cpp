// Bodies without tools: what must be conserved is conserved.
#include <gtest/gtest.h>

#include "components/body.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

struct Momentum {
  double x = 0, y = 0, angular = 0, size = 0;  // size: sum of |m v|, |m r v| to compare with
};

// Momentum at t_n from the velocities half a step before and the forces: m (v + a dt/2).
Momentum momentum(Experiment& e) {
  World& w = e.simulation.world();
  const Bodies& bodies = w.resource<Bodies>();
  const auto& x = w.column<Position<TwoD>>();
  const auto& v = w.column<Velocity<TwoD>>();
  Momentum p;
  for (const int slot : bodies.slot_of_number) {
    const Shape& shape = bodies.shape_of_slot(slot);
    const auto first =
        static_cast<std::size_t>(x.table.chunk_begin[static_cast<std::size_t>(slot / lane_count)]);
    const double rho = w.column<Density>().values()[static_cast<std::size_t>(slot)];
    for (std::size_t n = 0; n < shape.nodes.size(); ++n) {
      const double m = rho * bodies.thickness * shape.nodal_area[n];
      const Lane* at = x.lanes() + 2 * (first + n);
      const Lane* vel = v.lanes() + 2 * (first + n);
      const int l = slot % lane_count;
      p.x += m * vel[0][l];
      p.y += m * vel[1][l];
      p.angular += m * (at[0][l] * vel[1][l] - at[1][l] * vel[0][l]);
      p.size += m * std::hypot(vel[0][l], vel[1][l]);
    }
  }
  return p;
}

// `arm`: how far apart the lines of opposite forces may be, m.
void expect_momentum_and_energy_kept(const std::vector<std::string>& overrides, double arm,
                                     double energy = 0.01) {
  Experiment e("basic/oblique-impact.toml", overrides);
  const Momentum before = momentum(e);
  double friction = 0, deepest = 0;
  e.run(400, [&] {
    const Energies& now = e.results.energies();
    EXPECT_GE(now.friction, friction - 1e-15);  // dissipation never goes back
    friction = now.friction;
    deepest = std::max(deepest, e.value("contacts"));
  });
  const Momentum after = momentum(e);
  EXPECT_GT(deepest, 0);  // they did meet
  EXPECT_NEAR(after.x - before.x, 0, 1e-12 * before.size);
  EXPECT_NEAR(after.y - before.y, 0, 1e-12 * before.size);
  EXPECT_NEAR(after.angular - before.angular, 0, arm * before.size);
  EXPECT_LT(e.results.energy_balance_error(), energy);
}

class ObliqueImpact : public testing::TestWithParam<const char*> {};

TEST_P(ObliqueImpact, KeepsMomentumAndEnergy) {
  // The closest point, where the opposite forces act, is found to 1e-8 of an edge at worst.
  expect_momentum_and_energy_kept({std::string("contact.friction=") + GetParam()}, 5e-13);
}

// Stiff springs, and the inerters that go with them.
TEST_P(ObliqueImpact, WithStiffSpringsKeepsThemToo) {
  expect_momentum_and_energy_kept(
      {std::string("contact.friction=") + GetParam(), "contact.stiffness=12"}, 5e-13);
}

TEST_P(ObliqueImpact, OfDiscsOfOneAndFourElementsKeepsThemToo) {
  for (const char* edges : {"4", "8"})
    for (const char* formulation : {"one-point", "four-point"})
      expect_momentum_and_energy_kept(
          {std::string("contact.friction=") + GetParam(), "contact.stiffness=0.5",
           std::string("particle.disc.mesh.boundary_edges=") + edges, "particle.disc.mesh.rings=0",
           std::string("element.formulation=") + formulation},
          1e-8 * 3.14 * 10e-3 / std::stod(edges),
          // A blow that single elements answer lasts a few steps, and sliding turns within them: with one
          // point and friction 1 the balance is off by anything up to 1.7%, whatever the step.
          *edges == '4' && *formulation == 'o' ? 0.02 : 0.01);
}
INSTANTIATE_TEST_SUITE_P(Frictions, ObliqueImpact, testing::Values("0", "0.2", "1"));

TEST(SpinningDisc, ThousandTurnsLeaveTheStressAsItWas) {
  Experiment e("basic/spinning-disc.toml");
  const double end = e.simulation.clock().end;
  // The disc rings from its sudden start, undamped: compare means over many looks.
  const auto mean_stress_of = [&](double from, double to) {
    double sum = 0;
    const int looks = 400;
    for (int i = 0; i < looks; ++i) {
      e.simulation.run_until(from + (to - from) * i / looks);
      e.simulation.observe();
      e.results.sample();
      const std::vector<double> s = e.results.frame()[3];  // pressure
      for (const double v : s) sum += v / static_cast<double>(s.size()) / looks;
      e.simulation.move();
    }
    return sum;
  };
  const double first = mean_stress_of(0, 0.02 * end);
  const double last = mean_stress_of(0.98 * end, end);
  EXPECT_LT(first, -1e7);  // the spin pulls it apart
  EXPECT_NEAR(last / first, 1, 0.005);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
}

// The same deformed state, turned as a whole, has the same stress, turned.
TEST(Objectivity, StressTurnsWithASuperposedRotation) {
  std::vector<double> effective[2], pressure[2];
  for (int turned = 0; turned < 2; ++turned) {
    Experiment e("basic/spinning-disc.toml");
    auto& x = e.simulation.world().column<Position<TwoD>>();
    const double angle = turned != 0 ? 2.1 : 0, c = std::cos(angle), s = std::sin(angle);
    for (std::size_t n = 0; n < x.table.rows; ++n) {
      const double u = x.lanes()[2 * n][0], v = x.lanes()[2 * n + 1][0];
      const double p = u * 1.02 + 0.01 * v + 3 * u * v,
                   q = 0.97 * v - 2 * u * u;  // stretch, shear, bend
      x.lanes()[2 * n][0] = c * p - s * q;
      x.lanes()[2 * n + 1][0] = s * p + c * q;
    }
    e.simulation.observe();
    effective[turned] = e.results.frame()[2];
    pressure[turned] = e.results.frame()[3];
  }
  double largest = 0;
  for (const double v : effective[0]) largest = std::max(largest, v);
  for (std::size_t i = 0; i < effective[0].size(); ++i) {
    EXPECT_NEAR(effective[1][i], effective[0][i], 1e-9 * largest);
    EXPECT_NEAR(pressure[1][i], pressure[0][i], 1e-9 * largest);
  }
}

}  // namespace
}  // namespace pulvis
