// The elastic ball that adheres (JKR), held to the closed forms of Johnson, Kendall & Roberts (1971) and Maugis
// (1992): the law alone, and on levers.
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "scenes/lever/adhesion.hpp"
#include "scenes/lever/afm_curve.hpp"
#include "systems/lever/probe_contact_kernel.hpp"
#include "tests/helpers/afm_run.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using namespace kernels;
using std::numbers::pi;

constexpr AdhesiveBall polystyrene{3.7e9, 5e-6, 0.01};
constexpr double K = 4.0 / 3 * polystyrene.modulus, R = polystyrene.radius, w = polystyrene.work;

TEST(Jkr, AForceAloneLetsGoAtThreeHalvesPiWRAndAnApproachAloneAtFiveSixths) {
  const JkrScale law(polystyrene);
  const double off = 1.5 * pi * w * R;
  EXPECT_FALSE(jkr_balance(law, 1, 0, -off * (1 + 1e-9)).holds);
  ASSERT_TRUE(jkr_balance(law, 1, 0, -off * (1 - 1e-9)).holds);
  const double stays = std::cbrt(1.5 * pi * w * R * R / K);  // a_0/4^(1/3)
  EXPECT_NEAR(law.radius * std::pow(jkr_balance(law, 1, 0, -off * (1 - 1e-12)).q, 2) / stays, 1,
              1e-5);
  const double minimum = std::cbrt(pi * w * R * R / (6 * K)), lowest = -3 * minimum * minimum / R;
  EXPECT_EQ(jkr_radius(polystyrene, lowest * (1 + 1e-9)), 0);
  EXPECT_NEAR(jkr_radius(polystyrene, lowest * (1 - 1e-9)) / minimum, 1, 1e-4);
  EXPECT_NEAR(jkr_balance(law, 0, 1, lowest * (1 - 1e-12)).force / (-5.0 / 6 * pi * w * R), 1,
              1e-5);
}

TEST(Jkr, RadiusAndApproachAreThoseOfTheClosedForms) {
  const JkrScale law(polystyrene);
  const double a_0 = std::cbrt(6 * pi * w * R * R / K);  // without a load
  EXPECT_NEAR(law.radius * std::pow(jkr_balance(law, 1, 0, 0).q, 2) / a_0, 1, 1e-12);
  for (const double force : {-2e-7, -1e-8, 0.0, 1e-7, 1e-5}) {
    const double q = jkr_balance(law, 1, 0, force).q, adhesive = 3 * pi * w * R;
    const double a = std::cbrt(
        R / K * (force + adhesive + std::sqrt(2 * adhesive * force + adhesive * adhesive)));
    EXPECT_NEAR(law.radius * q * q / a, 1, 1e-12);
    const double approach = a * a / R - std::sqrt(8 * pi * w * a / (3 * K));
    EXPECT_NEAR(law.approach_at(q) / approach, 1, 1e-9);
    EXPECT_NEAR(jkr_radius(polystyrene, approach) / a, 1, 1e-9);
  }
}

// Many times the pull-off force adhesion is as good as not there.
TEST(Jkr, UnderALargeLoadItIsHertzs) {
  const JkrScale law(polystyrene);
  const double force = 1e6 * pi * w * R, a = std::cbrt(force * R / K);
  const double q = jkr_balance(law, 1, 0, force).q;
  EXPECT_NEAR(law.radius * q * q / a, 1, 1e-3);
  EXPECT_NEAR(law.approach_at(q) / (a * a / R), 1, 2e-3);
  EXPECT_NEAR(jkr_pressure(polystyrene, a) / (1.5 * force / (pi * a * a)), 1, 2e-3);
}

// Numbers of order one; the surface is round, so that the normal turns.
TEST(Jkr, TheLawOfAPointHasTheDerivativesOfItsEquations) {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  using State = ProbeEquation::State;
  ProbeLaw law{100, 80, 0.3, 0, 1, {1, 2, 0.5}};
  law.pull_off = jkr_pull_off(law.ball);
  const auto over_a_ball = [](const Vector3d& x) -> ProbePlace {
    const double r = x.norm();
    const Vector3d n = x / r;
    return {r - 2,
            n,
            (Matrix3d::Identity() - n * n.transpose()) / r,
            x - Vector3d(0.1, -0.05, 2.01),
            Vector3d(0.3, 0.1, 0),
            true};
  };
  const auto check = [&](State state, const Vector3d& f, const Vector3d& x) {
    constexpr double rho = 3, rho_t = 2, h = 1e-6;
    const auto at = [&](const Vector3d& force, const Vector3d& place) {
      return probe_equation(law, over_a_ball(place), force, rho, rho_t);
    };
    const ProbeEquation r = at(f, x);
    ASSERT_EQ(r.state, state);
    for (int k = 0; k < 3; ++k) {
      const Vector3d step = h * Vector3d::Unit(k);
      const Vector3d by_force = (at(f + step, x).residual - at(f - step, x).residual) / (2 * h);
      const Vector3d by_place = (at(f, x + step).residual - at(f, x - step).residual) / (2 * h);
      EXPECT_LT((r.by_force.col(k) - by_force).norm(), 1e-7) << k;
      EXPECT_LT((r.by_place.col(k) - by_place).norm(), 1e-7) << k;
    }
  };
  check(State::apart, {0.1, -0.2, 0.1}, {0.2, 0.1, 8});
  check(State::sticks, {0.1, -0.05, 2}, {0.1, -0.04, 1.98});
  check(State::slides, {0.9, -2.3, 1}, {0.4, 0.2, 1.9});
  check(State::slides, {0.9, -2.3, -1}, {0.3, 0.2, 2.15});
}

// What the scanner's height z gives on a spring of stiffness k: nothing before the ball has touched.
double on_spring(const AdhesiveBall& ball, double k, double z, bool& touches) {
  const JkrAnswer answer = jkr_balance(JkrScale(ball), 1, k, k * z);
  touches = (touches || z >= 0) && answer.holds;
  return touches ? answer.force : 0;
}

// Energy of a circle of contact that grew from nothing, integral of F d delta.
double energy(const AdhesiveBall& ball, double a) {
  const double k = 4.0 / 3 * ball.modulus, s = std::sqrt(6 * pi * ball.work * k),
               t = std::sqrt(8 * pi * ball.work / (3 * k));
  // F = k a^3/R - s a^1.5, d delta = (2a/R - t/2 a^-0.5) da
  const double r = ball.radius;
  return 2 * k * std::pow(a, 5) / (5 * r * r) - k * t * std::pow(a, 3.5) / (7 * r) -
         2 * s * std::pow(a, 3.5) / (3.5 * r) + s * t * a * a / 4;
}

// Area under the line of no force by the closed form; pull-off and work of adhesion as put in.
void expect_figures_of(const Scene& scene, const AfmHistory& h, double k) {
  const AdhesiveBall ball = adhesive_ball(scene);
  constexpr double step = 2e-11;
  double area = 0;
  bool holds = true;
  for (double z = 5e-8; holds; z -= step)
    area += step * std::max(-on_spring(ball, k, z, holds), 0.0);
  const std::vector<ForceCurveFigures> curves = force_curves(scene, h);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].action, 2);
  EXPECT_NEAR(curves[0].pull_off / pull_off_force(scene), 1, 1e-3);
  EXPECT_NEAR(curves[0].work / area, 1, 2e-3);
  EXPECT_NEAR(*curves[0].work_of_adhesion / 0.01, 1, 1e-3);
}

TEST(Jkr, AForceCurveOfALeverIsTheClosedForm) {
  const Scene scene = shipped_afm("jkr-force-curve.toml");
  AfmSimulation simulation(scene);
  const double k = simulation.calibrate().normal_stiffness;
  const AdhesiveBall ball = adhesive_ball(scene);
  const double off = pull_off_force(scene);
  EXPECT_NEAR(off, 1.5 * pi * 0.01 * 5e-6, 1e-20);
  const AfmHistory h = history_of(simulation);
  bool touches = false;
  double minimum = 0, before = 0, work = 0, in_at = -1, out_at = 1;
  for (std::size_t i = 1; i < h.rows.size(); ++i) {
    const double z = h.value(i, "scanner/z"), force = h.value(i, "probe/force_z");
    const bool touched = touches;
    const double expected = on_spring(ball, k, z, touches);
    if ((h.value(i, "contact/points") > 0) == touches) {
      EXPECT_NEAR(force, expected, 1e-3 * off) << z;
    } else {  // bent, the lever is another one by 1e-4
      ASSERT_FALSE(jkr_balance(JkrScale(ball), 1, k, k * 1.001 * z).holds) << z;
      touches = false;
    }
    if (touches && !touched) in_at = z;
    if (!touches && touched) out_at = h.value(i - 1, "scanner/z");
    if (touches) {
      const double adhesive = 2 * off,
                   a = std::cbrt(
                       0.75 * ball.radius / ball.modulus *
                       (force + adhesive + std::sqrt(2 * adhesive * force + adhesive * adhesive)));
      EXPECT_NEAR(h.value(i, "contact/radius") / a, 1, 2e-3) << z;
    }
    work += 0.5 * (force + before) * (z - h.value(i - 1, "scanner/z"));
    minimum = std::min(minimum, force);
    before = force;
  }
  EXPECT_NEAR(minimum / -off, 1, 1e-3);
  EXPECT_GE(in_at, 0);
  EXPECT_LT(in_at, 10.1e-9);  // an increment
  EXPECT_LT(out_at, 0);
  // What the loop eats is what the two jumps set free: at z = 0, of the contact that forms and the spring that it
  // stretches; at the pull-off, of the spring less what parting the contact still takes.
  const JkrScale law(ball);
  const JkrAnswer formed = jkr_balance(law, 1, k, 0);
  const double a_in = law.radius * formed.q * formed.q;
  const double released_in = -energy(ball, a_in) - 0.5 * formed.force * formed.force / k;
  const JkrAnswer last_hold = jkr_balance(law, 1, k, k * out_at);
  const double a_out = law.radius * last_hold.q * last_hold.q;
  const double released_out = energy(ball, a_out) + 0.5 * last_hold.force * last_hold.force / k;
  EXPECT_GT(released_in, 0);
  EXPECT_GT(released_out, released_in);
  EXPECT_NEAR(work / (released_in + released_out), 1, 0.005);
  expect_figures_of(scene, h, k);
}

// A soft ball on a stiff lever: the force passes its lowest value and comes back before the ball lets go, as a kept
// approach has it.
TEST(Jkr, AStiffLeverFollowsTheBallBeyondItsGreatestPull) {
  const Scene scene =
      shipped_afm("jkr-force-curve.toml",
                  {"lever.thickness=15 um", "material.polystyrene.youngs_modulus=10 MPa",
                   "tip.neck_radius=3 um", "action[0].distance=10 nm", "action[1].distance=30.3 nm",
                   "action[1].increments=5", "action[2].distance=30 nm", "action[2].increments=6",
                   "action[3].distance=60 nm", "action[3].increments=60"});
  AfmSimulation simulation(scene);
  const double k = simulation.calibrate().normal_stiffness;
  const AdhesiveBall ball = adhesive_ball(scene);
  const double off = pull_off_force(scene);
  const AfmHistory h = history_of(simulation);
  bool touches = false;
  double minimum = 0, held = 0;
  for (std::size_t i = 1; i < h.rows.size(); ++i) {
    const double force = h.value(i, "probe/force_z");
    EXPECT_NEAR(force, on_spring(ball, k, h.value(i, "scanner/z"), touches), 2e-3 * off);
    minimum = std::min(minimum, force);
    if (touches) held = force;
  }
  EXPECT_NEAR(minimum / -off, 1, 1e-3);
  EXPECT_GT(held, -0.9 * off);
  EXPECT_FALSE(touches);
}

// Friction feels the load and the pull-off force; on an incline the ball touches at its side.
TEST(Jkr, FrictionSeesTheLoadAndThePullOffForce) {
  const std::string programme =
      "[[action]]\nkind = \"press\"\nforce = \"100 nN\"\nincrements = 3\n"
      "[[action]]\nkind = \"scan\"\ndistance = \"60 nm\"\nset_point = \"force\"\nincrements = 10\n";
  for (const double degrees : {0.0, 14.0}) {
    const Scene shipped = shipped_afm("jkr-force-curve.toml");
    std::ostringstream content;
    content << std::ifstream(shipped.file).rdbuf();
    std::string text = content.str();
    text = text.substr(0, text.find("[[action]]"));
    text.insert(text.find("adhesion ="),
                "friction = 0.2\nincline = \"" + std::to_string(degrees) + " deg\"\n");
    const Scene scene = afm_scene(text + programme);
    const AfmHistory h = history_of(scene);
    const double load = 100e-9, off = pull_off_force(scene), theta = degrees * pi / 180;
    double maximum = 0;
    for (std::size_t i = 4; i < h.rows.size(); ++i) {
      EXPECT_NEAR(h.value(i, "probe/force_z") / load, 1, 1e-6);
      maximum = std::max(maximum, -h.value(i, "probe/force_y"));
    }
    const double up = (load * (std::sin(theta) + 0.2 * std::cos(theta)) + 0.2 * off) /
                      (std::cos(theta) - 0.2 * std::sin(theta));
    EXPECT_NEAR(maximum / up, 1, 1e-3) << degrees;
  }
}

TEST(Jkr, WhatItDoesNotHoldForIsRefused) {
  const auto refusal = [](const std::vector<std::string>& overrides) -> std::string {
    return message_of([&] { shipped_afm("jkr-force-curve.toml", overrides); });
  };
  const auto refused = [&](const std::vector<std::string>& overrides, const char* why) {
    EXPECT_NE(refusal(overrides).find(why), std::string::npos) << refusal(overrides);
  };
  refused({"surface.pull_off=1 nN"}, "surface.pull_off: belongs to another law");
  refused({"surface.adhesion_range=2 nm"}, "surface.adhesion_range: belongs to another law");
  refused({"surface.adhesion=dmt"}, "surface.work_of_adhesion: belongs to another law");
  refused({"surface.work_of_adhesion=0 J/m^2"}, "surface.work_of_adhesion");
  refused({"surface.work_of_adhesion=1 N"}, "surface.work_of_adhesion");
  refused({"tip.contact_edge=0.5 um"}, "not from its mesh");
  refused({"surface.shape=step", "surface.height=1 nm", "surface.slope=1"},
          "a surface of shape plane");
}

}  // namespace
}  // namespace pulvis
