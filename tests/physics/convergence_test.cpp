// Observed orders of convergence: leapfrog is of second order in the time step, the element in its size.
// Each takes three runs, one refined twice, and compares the two differences: no reference is needed, and
// halving something of second order makes the difference four times as small.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "components/body.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

using Overrides = std::vector<std::string>;

// Positions of all nodes at the end of the run.
std::vector<double> end_positions(const std::string& scene, const Overrides& overrides) {
  Experiment e(scene, overrides);
  e.simulation.run_until(e.simulation.clock().end);
  e.simulation.observe();
  return e.results.frame()[0];
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

double order_in_time(const std::string& scene, const std::array<double, 3>& safeties,
                     const Overrides& overrides) {
  std::array<std::vector<double>, 3> ends;
  for (std::size_t i = 0; i < 3; ++i) {
    Overrides all = overrides;
    all.push_back("time.safety=" + std::to_string(safeties[i]));
    ends[i] = end_positions(scene, all);
  }
  return std::log2(distance(ends[0], ends[1]) / distance(ends[1], ends[2]));
}

// A disc that suddenly spins: it breathes and rings while it turns by 46 degrees.
TEST(ConvergenceInTime, FreeOscillationIsOfSecondOrder) {
  EXPECT_NEAR(
      order_in_time("basic/spinning-disc.toml", {0.4, 0.2, 0.1}, {"stage.spin.duration=\"20 us\""}),
      2, 0.2);
}

// Surfaces that touch all the time: the contact spring is as smooth as the elements.
TEST(ConvergenceInTime, ContactThatStaysClosedIsOfSecondOrder) {
  EXPECT_NEAR(order_in_time("basic/patch-test.toml", {0.8, 0.4, 0.2},
                            {"stage.press.duration=\"0.05 ms\"", "contact.damping=0"}),
              2, 0.2);
}

// Points that come into contact between two steps: the force has a kink in time there, which costs up to
// half an order. It must stay well above the first order of a force that jumps.
class OrderOfImpact : public testing::TestWithParam<const char*> {};
TEST_P(OrderOfImpact, LiesBetweenFirstAndSecond) {
  const double order = order_in_time("basic/oblique-impact.toml", {0.4, 0.2, 0.1},
                                     {std::string("contact.friction=") + GetParam()});
  EXPECT_GT(order, 1.3);
  EXPECT_LT(order, 2.2);
}
INSTANTIATE_TEST_SUITE_P(Frictions, OrderOfImpact, testing::Values("0", "0.2"));

// The spinning disc again, smooth in space: its elastic energy while it swells for the first time. The
// time step follows the mesh, so this holds time and space together.
class OrderInSpace : public testing::TestWithParam<const char*> {};
TEST_P(OrderInSpace, EnergyOfTheSwellingDiscIsOfSecondOrder) {
  std::array<double, 3> energy{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int edges = 32 << i, rings = 2 << i;
    Experiment e("basic/spinning-disc.toml",
                 {"particle.disc.mesh.boundary_edges=" + std::to_string(edges),
                  "particle.disc.mesh.rings=" + std::to_string(rings),
                  std::string("stage.spin.duration=\"") + GetParam() + " us\""});
    e.run(1);
    energy[i] = e.results.energies().elastic;
  }
  const double order = std::log2((energy[0] - energy[1]) / (energy[1] - energy[2]));
  EXPECT_NEAR(order, 2.1, 0.4);
}
INSTANTIATE_TEST_SUITE_P(Microseconds, OrderInSpace, testing::Values("0.3", "0.5", "0.7"));

}  // namespace
}  // namespace pulvis
