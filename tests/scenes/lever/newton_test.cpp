// Newton's method with a consistent tangent: each residual goes as the square of the one before, three times in
// turn or more.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "components/probe.hpp"
#include "components/solid.hpp"
#include "engine/workers.hpp"
#include "scenes/lever/afm_programme.hpp"
#include "tests/helpers/lever.hpp"

namespace pulvis {
namespace {

// From `near` on r' <= most r^2, but for round-off. A method that gains a digit an iteration fails at the third.
void expect_squares(const std::vector<double>& r) {
  constexpr double near = 0.1, maximum = 50, round_off = 1e-11;
  int squared = 0;
  // What is out of balance is largest once the load, or the contact's new forces, have come.
  const auto most_out = static_cast<std::size_t>(std::ranges::max_element(r) - r.begin());
  for (std::size_t i = most_out; i + 1 < r.size(); ++i) {
    if (squared == 0 && r[i] > near) continue;
    if (r[i] < 1e-7) break;  // its square is round-off
    EXPECT_LE(r[i + 1], maximum * r[i] * r[i] + round_off) << i;
    ++squared;
  }
  EXPECT_GE(squared, 3) << testing::PrintToString(r);
}

// 20 times as long as thick: thinner ones lose more digits to round-off.
constexpr const char* thick[] = {"lever.length=100 um", "lever.width=10 um", "lever.thickness=5 um",
                                 "lever.aspect=1"};

// P L^2/(E I) = 3: the end goes aside by 60% of the length, in one step.
TEST(Newton, ConvergesQuadraticallyOnALeverThatBendsFar) {
  const Scene scene = afm_scene(tipless_beam(), {std::begin(thick), std::end(thick)});
  AfmSimulation simulation(scene);
  const double inertia = 10e-6 * std::pow(5e-6, 3) / 12, length = 100e-6;
  const NewtonReport report =
      simulation.load_tip({0, 0, 3 * 200e9 * inertia / (length * length)}, {.tolerance = 1e-13});
  ASSERT_TRUE(report.converged);
  expect_squares(report.residuals);
}

// Up an incline with friction, by 4% of the lever's length at once: the contact's non-smooth points are settled within each
// iteration, the solid sees a smooth answer.
TEST(Newton, ConvergesQuadraticallyInAStepOfContact) {
  std::vector<std::string> overrides(std::begin(thick), std::end(thick));
  overrides.push_back("tip.set_back=5 um");
  const Scene scene =
      afm_scene(coarse_beam + inclined_plane(14, 0.1) + press_and_scan(8), overrides);
  AfmModel model = build_afm(scene);
  add_probe(scene, model);
  Workers(1).run([&] {
    StaticSolver solver(*model.world);
    solver.linearise();
    place_target(scene, model, 1e5);
    for (const double rise : {1e-6, 4e-6}) {
      model.world->resource<Target>().travel[2] += rise;
      const NewtonReport report = solver.equilibrate({.tolerance = 1e-13, .round_off = 1e-10});
      ASSERT_TRUE(report.converged);
      if (rise > 1e-6) expect_squares(report.residuals);
      solver.commit();
    }
  });
}

}  // namespace
}  // namespace pulvis
