// The skin check: rows are made anew in time, so that no contact is missed, and not for what surfaces move
// together.
#include <gtest/gtest.h>

#include <random>

#include "systems/contact/skin_kernel.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

using Points = std::vector<double>;

Box box_around(const Points& points) {
  return box_of(points.data(), static_cast<int>(points.size()) / 2);
}

Points difference(const Points& a, const Points& b) {
  Points u(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) u[i] = a[i] - b[i];
  return u;
}

// Two bodies of random points that move at random: if their boxes meet, they have closed in by the gap.
TEST(SkinKernel, BodiesThatMeetHaveClosedInByTheirGap) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> in(-1, 1);
  int met = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Points a(8), b(8), a_now(8), b_now(8);
    const double shift[2] = {3 * in(random), 3 * in(random)}, size = 2 * std::abs(in(random));
    for (std::size_t i = 0; i < 8; ++i) {
      a[i] = in(random);
      b[i] = in(random) + shift[i % 2];
      a_now[i] = a[i] + size * in(random);
      b_now[i] = b[i] + size * in(random);
    }
    const double gap = kernels::gap(box_around(a), box_around(b));
    if (gap <= 0 || kernels::gap(box_around(a_now), box_around(b_now)) > 0) continue;
    ++met;
    EXPECT_GE(kernels::closing(box_around(difference(a_now, a)), box_around(difference(b_now, b))),
              gap);
  }
  EXPECT_GT(met, 500);
}

TEST(SkinKernel, GapIsThatAlongTheAxisThatPartsThemMost) {
  const Box a{{0, 0}, {1, 1}}, b{{3, 1.5}, {4, 2}};
  EXPECT_EQ(kernels::gap(a, b), 2);
  EXPECT_EQ(kernels::gap(b, a), 2);
  EXPECT_LT(kernels::gap(a, Box{{0.5, 0.5}, {2, 2}}), 0);
}

TEST(SkinKernel, CommonMotionIsNone) {
  const Box u{{3, -7}, {3, -7}}, half{{3, -7}, {3.5, -7}};
  EXPECT_EQ(kernels::closing(u, u), 0);
  EXPECT_EQ(kernels::closing(u, half), 0.5);
  EXPECT_EQ(kernels::closing(half, half), 0.5);  // an outline that is pressed flat
}

TEST(SkinKernel, LeastAlongANormalIsACorner) {
  const Box box{{-1, 2}, {3, 5}};
  EXPECT_DOUBLE_EQ(kernels::min_along(box, {0, 1}), 2);
  EXPECT_DOUBLE_EQ(kernels::min_along(box, {0, -1}), -5);
  EXPECT_DOUBLE_EQ(kernels::min_along(box, {0.6, -0.8}), -0.6 - 4);
}

// ---- against rows that are made anew in every step ----------------------------------------------------
struct Touch {
  std::int64_t touching;
  double contact_energy, external_work;
};

std::vector<Touch> run(const std::string& scene, const std::vector<std::string>& changes, int steps,
                       bool anew) {
  Experiment e(scene, changes);
  std::vector<Touch> touches;
  for (int i = 0; i < steps; ++i) {
    if (anew) e.simulation.world().resource<ContactIndex>().motion_at_bin = -1;
    e.simulation.run_steps(1);
    const Totals& t = e.simulation.world().resource<Totals>();
    touches.push_back({t.touching, t.contact_energy, t.external_work});
  }
  const auto bins = e.simulation.world().resource<ContactIndex>().bins;
  if (anew) {
    EXPECT_EQ(bins, steps + 1);  // and at the start
  } else {
    EXPECT_LT(bins, steps / 20);
    EXPECT_GT(bins, 1);
  }
  return touches;
}

void expect_same(const std::string& scene, const std::vector<std::string>& changes, int steps) {
  const auto seldom = run(scene, changes, steps, false), anew = run(scene, changes, steps, true);
  std::int64_t maximum = 0;
  double energy = 0, work = 0;
  for (std::size_t i = 0; i < seldom.size(); ++i) {
    maximum = std::max(maximum, anew[i].touching);
    energy = std::max(energy, anew[i].contact_energy);
    work = std::max(work, std::abs(anew[i].external_work));
    ASSERT_EQ(seldom[i].touching, anew[i].touching) << scene << ", step " << i;
    ASSERT_NEAR(seldom[i].contact_energy, anew[i].contact_energy, 1e-6 * energy)
        << scene << ", step " << i;
    ASSERT_NEAR(seldom[i].external_work, anew[i].external_work, 1e-6 * work);
  }
  EXPECT_GT(maximum, 1);
}

TEST(SkinCheck, NoContactIsMissedUnderAFastPunch) {
  expect_same(
      "compaction/regular-25.toml",
      {"stage.press.duration=50 us", "stage.press.move[0].displacement=[\"0 mm\", \"-1.25 mm\"]"},
      500);
}

TEST(SkinCheck, NoContactIsMissedInAnImpact) {
  expect_same("basic/oblique-impact.toml", {"stage.impact.duration=1 ms"}, 1500);
}

TEST(SkinCheck, NoContactIsMissedOnAPolyline) {
  expect_same(
      "basic/groove-wedge.toml",
      {"stage.press.duration=60 us", "stage.press.move[0].displacement=[\"0 mm\", \"-0.5 mm\"]"},
      1200);
}

// ---- not for what surfaces move together --------------------------------------------------------------
Scene flight(double apart) {
  Scene scene = read_scene(paths::source_dir() + "/scenes/basic/oblique-impact.toml");
  for (BodySpec& body : scene.bodies) {
    body.velocity = Vec3(100, -50, 0);
    body.angular_velocity = Vec3::Zero();
  }
  scene.bodies[0].position = Vec3::Zero();
  scene.bodies[1].position = Vec3(apart, 0, 0);
  return scene;
}

TEST(SkinCheck, ParticlesThatFlyTogetherKeepTheirRows) {
  for (const double apart : {10.1e-3, 50e-3}) {
    Experiment e(flight(apart));
    e.simulation.run_steps(1000);
    const auto& index = e.simulation.world().resource<ContactIndex>();
    EXPECT_GT(e.simulation.clock().relative_motion, 20 * index.skin);
    EXPECT_EQ(index.bins, 1);
  }
}

}  // namespace
}  // namespace pulvis
