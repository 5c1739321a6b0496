// Bulk damping against Rayleigh's law: modes decay with the ratio alpha/(2 omega) + beta omega/2, a rotation does
// not, what is taken out of the motion is in the balance, and a strut comes to rest at its static force.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "components/body.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/free_bar.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

struct Damping {
  double alpha = 0, beta = 0;  // 1/s, s
};

std::string table_of(const Damping& d) {
  char text[120];
  std::snprintf(text, sizeof text,
                "[material.damping]\nmass_proportional = \"%.9g 1/s\"\n"
                "stiffness_proportional = \"%.9g s\"\n",
                d.alpha, d.beta);
  return text;
}

std::string bar_text(const std::string& formulation, const Damping& damping, int rows) {
  return FreeBar{formulation, 20, rows, 0.3, table_of(damping), "2 ms"}.text();
}

constexpr double pi = std::numbers::pi, length = 20e-3;

double along(double x) { return -std::sin(pi * x); }  // free-free, x in [-1/2, 1/2]
// The first mode of a free bar, set off by its velocity: angular frequency and damping ratio from the
// displacement, its crossings of zero and its extremes over five periods.
struct Oscillation {
  double omega = 0, ratio = 0, balance = 0;
};
Oscillation oscillate(const std::string& formulation, const Damping& damping, bool bends) {
  const Scene scene =
      load_scene_text(bar_text(formulation, damping, bends ? 1 : 2), "bar.toml").scene;
  Simulation simulation(scene);
  World& w = simulation.world();
  Results results(scene, w);
  auto& x = w.column<Position<TwoD>>();
  auto& v = w.column<Velocity<TwoD>>();
  const std::vector<double> area = w.resource<Bodies>().shapes[0].nodal_area;
  const std::size_t axis = bends ? 1 : 0;
  std::vector<double> mode, start;
  for (std::size_t n = 0; n < area.size(); ++n) {
    const double at = x.lanes()[2 * n][0] / length;
    mode.push_back(bends ? bending_mode(at) : along(at));
    start.push_back(x.lanes()[2 * n + axis][0]);
    v.lanes()[2 * n + axis][0] = 0.05 * mode.back();
  }
  std::vector<double> crossings, extremes;
  double before = 0, when = 0, largest = 0;
  while (crossings.size() < 11 && !simulation.finished()) {
    simulation.observe();
    results.sample();
    double q = 0;
    for (std::size_t n = 0; n < area.size(); ++n)
      q += area[n] * mode[n] * (x.lanes()[2 * n + axis][0] - start[n]);
    const double now = simulation.clock().time;
    if (before * q < 0) {
      crossings.push_back(when + (now - when) * before / (before - q));
      extremes.push_back(largest);
      largest = 0;
    }
    largest = std::max(largest, std::abs(q));
    before = q;
    when = now;
    simulation.move();
  }
  Oscillation found;
  if (crossings.size() < 11) return found;
  const double decrement = std::log(extremes[0] / extremes[10]) / 10;  // of half a period
  found.ratio = decrement / std::hypot(pi, decrement);
  found.omega = 10 * pi / (crossings[10] - crossings[0]) / std::sqrt(1 - found.ratio * found.ratio);
  found.balance = results.energy_balance_error();
  return found;
}

void expect_rayleigh(const std::string& formulation, bool bends) {
  const double omega = oscillate(formulation, {}, bends).omega;
  ASSERT_GT(omega, 0);
  for (const double a : {0.0, 0.03, 0.015}) {
    const double b = a == 0.015 ? 0.015 : 0.03 - a;
    const Damping damping{2 * a * omega, 2 * b / omega};
    const Oscillation found = oscillate(formulation, damping, bends);
    EXPECT_NEAR(found.ratio / (a + b), 1, 0.01) << formulation << " " << a << " " << b;
    EXPECT_NEAR(found.omega / omega, 1, 0.002);
    EXPECT_LT(found.balance, 1e-3);
  }
}

TEST(BulkDamping, ABarsLengthwiseModeDecaysAsRayleighSays) {
  for (const char* formulation : {"one-point", "four-point", "standard"})
    expect_rayleigh(formulation, false);
}

TEST(BulkDamping, ABendingModeDecaysAsRayleighSays) {
  for (const char* formulation : {"one-point", "four-point", "standard"})
    expect_rayleigh(formulation, true);
}

TEST(BulkDamping, WithoutItNothingDecays) {
  EXPECT_LT(std::abs(oscillate("one-point", {}, false).ratio), 1e-4);
}

// ---- objectivity --------------------------------------------------------------------------------------
TEST(BulkDamping, OfStiffnessLeavesAFastRotationAlone) {
  for (const char* formulation : {"one-point", "four-point", "standard"}) {
    Experiment e("basic/spinning-disc.toml",
                 {"material.steel.damping.stiffness_proportional=2e-8 s",
                  std::string("element.formulation=") + formulation});
    const double end = e.simulation.clock().end;
    const auto observe_at = [&](double time) {
      e.simulation.run_until(time);
      e.simulation.observe();
      e.results.sample();
      const std::pair<double, Energies> seen{e.results.momentum()[2], e.results.energies()};
      e.simulation.move();
      return seen;
    };
    const auto [spin, first] = observe_at(0);
    const auto [later_spin, later] = observe_at(0.01 * end);
    const auto [last_spin, last] = observe_at(0.02 * end);
    EXPECT_NEAR(last_spin / spin, 1, 1e-11);
    EXPECT_GT(later.bulk_damping, 1e-6 * first.kinetic);  // the ringing of its sudden start
    EXPECT_LT(last.bulk_damping - later.bulk_damping, 1e-9 * first.kinetic);
    EXPECT_LT(e.results.energy_balance_error(), 1e-3);
  }
}

// A rigid motion of any size has no viscous force at all: checked on one step of the force alone.
TEST(BulkDamping, OfStiffnessSeesNoForceInARigidTurnBetweenTwoSteps) {
  for (const char* formulation : {"one-point", "four-point", "standard"}) {
    Experiment e("basic/spinning-disc.toml",
                 {"material.steel.damping.stiffness_proportional=2e-8 s",
                  std::string("element.formulation=") + formulation});
    World& w = e.simulation.world();
    const double dt = 1e-8, angle = 0.3;
    w.resource<Clock>().dt_before = dt;
    auto& x = w.column<Position<TwoD>>();
    auto& v = w.column<Velocity<TwoD>>();
    for (std::size_t n = 0; n < x.table.rows; ++n) {
      const double px = x.lanes()[2 * n][0], py = x.lanes()[2 * n + 1][0];
      const double qx = std::cos(angle) * px - std::sin(angle) * py;
      const double qy = std::sin(angle) * px + std::cos(angle) * py;
      x.lanes()[2 * n][0] = qx, x.lanes()[2 * n + 1][0] = qy;
      v.lanes()[2 * n][0] = (qx - px) / dt, v.lanes()[2 * n + 1][0] = (qy - py) / dt;
    }
    e.simulation.observe();
    const auto& f = e.column<DampingForce<TwoD>>();
    double largest = 0;
    for (std::size_t i = 0; i < 2 * f.table.rows; ++i)
      largest =
          std::max(largest, std::abs(const_cast<Column<DampingForce<TwoD>>&>(f).lanes()[i][0]));
    // Of beta E times the rate of turning, over an edge of 1 mm and 1 mm of thickness.
    EXPECT_LT(largest, 1e-10 * 2e-8 * 200e9 * angle / dt * 1e-6) << formulation;
  }
}

TEST(BulkDamping, OfMassSlowsARotationByItsRate) {
  const double alpha = 2e3, time = 200e-6;
  Experiment e("basic/spinning-disc.toml", {"material.steel.damping.mass_proportional=2e3 1/s"});
  const double before = e.results.momentum()[2];
  e.simulation.run_until(time);
  const double passed = e.simulation.clock().time;
  EXPECT_NEAR(std::log(before / e.results.momentum()[2]) / (alpha * passed), 1, 2e-3);
}

// ---- coming to rest -----------------------------------------------------------------------------------
struct Ringing {
  double minimum = 1e300, maximum = -1e300;  // of the static force, over the last third of the run
  double balance = 0;
};
Ringing strut(const std::vector<std::string>& changes) {
  Experiment e("basic/damped-strut.toml", changes);
  const double still = 200e9 / (1 - 0.09) * 2e-3 * 1e-3 * 20e-6 / 20e-3;
  Ringing found;
  double spent = 0;
  e.run(400, [&] {
    EXPECT_GE(e.results.energies().bulk_damping, spent * (1 - 1e-12));
    spent = e.results.energies().bulk_damping;
    if (e.simulation.clock().time < 2.0 / 3 * e.simulation.clock().end) return;
    const double share = e.value("tool/head/force_y") / still;
    found.minimum = std::min(found.minimum, share);
    found.maximum = std::max(found.maximum, share);
  });
  found.balance = e.results.energy_balance_error();
  return found;
}

TEST(BulkDamping, AStrutComesToRestAtItsStaticForce) {
  const Ringing free = strut({"material.steel.damping.mass_proportional=0 1/s"});
  EXPECT_LT(free.minimum, 0.83);
  EXPECT_GT(free.maximum, 1.17);
  for (const char* formulation : {"one-point", "four-point", "standard"}) {
    const Ringing damped = strut({std::string("element.formulation=") + formulation});
    EXPECT_NEAR(damped.minimum, 1, 0.01) << formulation;
    EXPECT_NEAR(damped.maximum, 1, 0.01) << formulation;
    EXPECT_LT(damped.balance, 1e-3) << formulation;
  }
}

// ---- stable time step -----------------------------------------------------------------------------------
// Damping of thousands of times critical: explicit, so the step is shorter, and the run stays stable.
std::vector<std::string> damped(double alpha, double beta) {
  return {"material.steel.damping.mass_proportional=" + std::to_string(alpha) + " 1/s",
          "material.steel.damping.stiffness_proportional=" + std::to_string(beta * 1e9) + " ns"};
}

TEST(BulkDamping, TheTimeStepKnowsIt) {
  const auto step_with = [](double alpha, double beta) {
    auto overrides = damped(alpha, beta);
    overrides.emplace_back("time.estimate=element");
    Experiment e("basic/damped-strut.toml", overrides);
    return e.simulation.clock().dt / e.scene.time.safety;
  };
  const double omega = 2 / step_with(0, 0);
  for (const auto& [alpha, beta] :
       {std::pair{0.0, 1e-6}, std::pair{1e9, 0.0}, std::pair{1e7, 1e-7}}) {
    const double xi = alpha / (2 * omega) + beta * omega / 2;
    EXPECT_NEAR(step_with(alpha, beta) * omega / 2 / (std::sqrt(1 + xi * xi) - xi), 1, 1e-9);
  }
}

TEST(BulkDamping, StrongDampingStaysStable) {
  for (const char* formulation : {"one-point", "four-point", "standard"})
    for (const auto& [alpha, beta] :
         {std::pair{0.0, 1e-6}, std::pair{3e8, 0.0}, std::pair{1e7, 2e-8}}) {
      std::vector<std::string> changes = damped(alpha, beta);
      changes.insert(changes.end(),
                     {std::string("element.formulation=") + formulation, "time.safety=0.99"});
      Experiment e("basic/damped-strut.toml", changes);
      for (int i = 0; i < 2; ++i) {
        e.simulation.observe();
        e.results.sample();
        e.simulation.move();
        e.simulation.run_steps(3000);
      }
      EXPECT_LT(e.results.energies().kinetic, 1e-2);  // J; it would have grown beyond all bounds
      EXPECT_LT(e.results.energy_balance_error(), 5e-3)
          << formulation << " " << alpha << " " << beta;
    }
}

// ---- what is refused ---------------------------------------------------------------------------------------
std::string refusal_of(const std::string& key, const std::string& value) {
  std::string text = bar_text("one-point", {}, 1);
  const auto at = text.find(key + " = ");
  text.replace(at, text.find('\n', at) - at, value);
  return message_of([&] { load_scene_text(text, "bar.toml"); });
}

TEST(BulkDamping, IsRefusedWhereItIsWrong) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal_of("mass_proportional", "mass_proportional = \"-1 1/s\""),
              HasSubstr("bar.toml:10:21: material[0].damping.mass_proportional: "));
  EXPECT_THAT(refusal_of("stiffness_proportional", "stiffness_proportional = \"1 1/s\""),
              HasSubstr("bar.toml:11:26: material[0].damping.stiffness_proportional: "));
  EXPECT_THAT(refusal_of("mass_proportional", "mass_proportionel = \"1 1/s\""),
              HasSubstr("did you mean 'mass_proportional'?"));
  EXPECT_THAT(message_of([] {
                read_scene(paths::source_dir() + "/scenes/afm/calibration-beam.toml",
                           {"material[0].damping.mass_proportional=1 1/s"});
              }),
              HasSubstr("only with \"compaction\""));
}

// ---- only where asked, the same for all threads -----------------------------------------------------------
TEST(BulkDamping, TakesNothingUnlessAsked) {
  Experiment plain("basic/damped-strut.toml", {"material.steel.damping.mass_proportional=0 1/s"});
  EXPECT_FALSE(plain.simulation.world().has<DampingForce<TwoD>>());
  EXPECT_FALSE(plain.simulation.world().has<MassDamping>());
  for (const System& system : step_list(plain.simulation.world()).forces)
    EXPECT_NE(std::string(system.name), "damping_force");
  EXPECT_FALSE(plain.results.has("energy/bulk_damping"));
  Experiment damped("basic/damped-strut.toml");
  EXPECT_TRUE(damped.simulation.world().has<DampingForce<TwoD>>());
}

TEST(BulkDamping, ThreadsDoNotChangeABit) {
  std::vector<double> states[2];
  for (int t = 0; t < 2; ++t) {
    Experiment e(
        "compaction/regular-25.toml",
        {"stage.press.duration=50 us", "stage.press.move[0].displacement=[\"0 mm\", \"-1.25 mm\"]",
         "material[0].damping.mass_proportional=1e5 1/s",
         "material[0].damping.stiffness_proportional=5 ns"},
        t + 1);
    e.simulation.run_steps(300);
    const auto& v = e.column<Velocity<TwoD>>();
    const double* values = v.values();
    states[t].assign(values, values + v.bytes() / sizeof(double));
    const auto& work = e.column<DampingWork>();
    states[t].insert(states[t].end(), work.values(), work.values() + work.bytes() / sizeof(double));
  }
  EXPECT_TRUE(states[0] == states[1]);
}

}  // namespace
}  // namespace pulvis
