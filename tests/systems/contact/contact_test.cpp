// Contact between two deformable particles: forces from an energy, momentum, patch test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "engine/run_failure.hpp"
#include "scenes/build.hpp"
#include "systems/body/systems.hpp"
#include "systems/contact/systems.hpp"
#include "systems/step.hpp"

namespace pulvis {
namespace {

MaterialSpec steel() { return {"steel", 7850, 200e9, 0.3, {}, 0, {}, {}}; }

Scene two_discs(double distance, double angle, double friction = 0) {
  Scene scene;
  scene.materials = {steel()};
  scene.particles = {{"disc", 0, DiscOutline{10e-3}, DiscMesh{40, 1, 1}, false, 0, {}}};
  BodySpec left, right;
  right.position = distance * Vec3(std::cos(angle), std::sin(angle), 0);
  scene.bodies = {left, right};
  scene.stages.emplace_back().duration = 1e-3;
  scene.contact.friction = friction;
  return scene;
}

// Contact forces and energy of a world at its present positions, without moving it.
struct Contacts {
  explicit Contacts(World& w) : world(w) {}
  void update() {
    TaskGraph(start_list(world), world.chunks()).run();
    world.resource<ContactIndex>().motion_at_bin = -1;  // positions were set by hand: bin anew
    std::vector<System> forces;
    for (System& system : step_list(world).forces)
      if (system.name == "bin_edges" || system.name == "skin_check" ||
          system.name == "edge_contact" || system.name == "contact_totals" ||
          system.name == "contact_force")
        forces.push_back(std::move(system));
    TaskGraph(std::move(forces), world.chunks()).run();
  }
  double energy() const { return world.resource<Totals>().contact_energy; }
  World& world;
};

// Rows are worked on two by two: one that is left over must count once. All rows are looked at here.
TEST(Contact, EveryTouchingRowIsCountedOnce) {
  int left_over_and_touching = 0;
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.0314 * i, shift = 160e-6;
    Scene scene = two_discs(10.1e-3, angle);
    scene.bodies[1].angle =
        0.05;  // not each other's mirror image, which would have an even number of rows
    const auto world = build_world(scene);
    const int right = world->resource<Bodies>().slot_of_number[1];
    auto& x = world->column<Position<TwoD>>();
    for (std::size_t node = 0; node < x.table.rows; ++node) {
      x.lanes()[2 * node][right] -= shift * std::cos(angle);
      x.lanes()[2 * node + 1][right] -= shift * std::sin(angle);
    }
    Contacts(*world).update();
    const auto& touches = world->column<ContactTouches<Contact>>();
    const std::size_t rows = touches.table.rows;
    std::int64_t touching = 0;
    for (std::size_t r = 0; r < rows; ++r) touching += touches.values()[r];
    ASSERT_GT(touching, 0);
    EXPECT_EQ(world->resource<Totals>().touching, touching);
    if (rows % 2 != 0 && touches.values()[rows - 1] != 0) ++left_over_and_touching;
  }
  EXPECT_GT(left_over_and_touching, 0);
}

// Closest points that are put on the far side of an outline of 200 edges are farther away than the search goes.
class LostPoints {
 public:
  explicit LostPoints(double limit) {
    Scene scene = two_discs(10e-3, 0);
    scene.particles[0].mesh = DiscMesh{200, 1, 1};
    scene.limits.unconverged_projections = limit;
    scene.limits.penetration = 1e6;  // what is not found may look deep
    world = build_world(scene);
    Contacts(*world).update();
    auto& closest = world->column<ClosestPoint>();
    for (std::size_t r = 0; r < closest.table.rows; ++r)
      for (std::size_t g = 0; g < edge_points; ++g) {
        PackedCurvePoint& point = closest.values()[edge_points * r + g];
        point = CurvePoint{(point.unpacked().edge + 100) % 200, 0.5}.packed();
      }
    for (System& system : step_list(*world).forces)
      if (system.name == "edge_contact" || system.name == "contact_totals" ||
          system.name == "contact_health")
        step_.push_back(std::move(system));
  }
  const Totals& look() {
    std::fill_n(world->column<ReactivationDistance<Contact>>().values(),
                world->column<ReactivationDistance<Contact>>().table.rows, 0.0);
    TaskGraph(step_, world->chunks()).run();
    return world->resource<Totals>();
  }
  std::unique_ptr<World> world;

 private:
  std::vector<System> step_;
};

TEST(Contact, CountsTheClosestPointsThatItDoesNotFind) {
  LostPoints lost(1);
  const auto points = static_cast<std::int64_t>(4 * lost.world->column<ClosestPoint>().table.rows);
  const Totals before = lost.world->resource<Totals>();
  EXPECT_EQ(before.projections, points);
  EXPECT_EQ(before.unconverged, 0);
  const Totals first = lost.look();
  EXPECT_EQ(first.projections, 2 * points);
  EXPECT_GT(first.unconverged, points / 2);
  EXPECT_EQ(first.unconverged_share(), static_cast<double>(first.unconverged) / 10000);
  // The search goes on from where it stopped, and comes round in the third step.
  lost.look();
  const std::int64_t second = lost.look().unconverged;
  EXPECT_EQ(lost.look().unconverged, second);
}

TEST(Contact, StopsWhereTooManyClosestPointsAreNotFound) {
  LostPoints lost(1e-3);
  try {
    lost.look();
    FAIL() << "went on";
  } catch (const RunFailure& failure) {
    EXPECT_THAT(failure.what(),
                ::testing::MatchesRegex(
                    "edge_contact: particle [01], edge [0-9]+ against particle [01]: the closest "
                    "point was not found by Newton's method, at step 0, t = 0 s, as for "
                    "[0-9]+ of [0-9]+ points so far, a share of 0.0[0-9]+; allowed 0.001 "
                    "\\(limits.unconverged_projections; a finer mesh may help\\)"));
  }
}

TEST(Contact, ForceIsMinusTheGradientOfTheEnergy) {
  const auto world = build_world(two_discs(10e-3, 0.7));
  auto& x = world->column<Position<TwoD>>();
  const std::size_t nodes = x.table.rows;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> noise(-2e-6, 2e-6);
  for (std::size_t i = 0; i < 2 * nodes; ++i)
    for (int l = 0; l < 2; ++l) x.lanes()[i][l] += noise(random) + (l == 1 ? -12e-6 : 0);
  Contacts contacts(*world);
  contacts.update();
  ASSERT_GT(contacts.energy(), 0);
  const auto& f = world->column<ContactForce<TwoD>>();
  std::vector<Lane> force(f.lanes(), f.lanes() + 2 * f.table.rows);
  double largest = 0;
  for (const Lane& v : force) largest = std::max({largest, std::abs(v[0]), std::abs(v[1])});
  const double h = 1e-9;
  for (std::size_t i = 0; i < force.size(); ++i)
    for (int l = 0; l < 2; ++l) {
      const double was = x.lanes()[i][l];
      x.lanes()[i][l] = was + h;
      contacts.update();
      const double up = contacts.energy();
      x.lanes()[i][l] = was - h;
      contacts.update();
      const double down = contacts.energy();
      x.lanes()[i][l] = was;
      // Central differences of a quadratic energy with a kink where points touch: h / penetration.
      EXPECT_NEAR(-(up - down) / (2 * h), force[i][l], 2e-4 * largest)
          << "node " << i / 2 << " lane " << l;
    }
}

// A long bar bent to a ring whose ends meet: the same outline on both sides of the contact.
class BentBar {
 public:
  BentBar() {
    Scene scene;
    scene.materials = {steel()};
    scene.particles = {
        {"bar", 0, RectangleOutline{length, 4e-3}, RectangleMesh{40, 4}, false, 0, {}}};
    BodySpec bar, far;
    far.position = Vec3(0, 0.2, 0);
    scene.bodies = {bar, far};
    scene.stages.emplace_back().duration = 1e-3;
    scene.contact.friction = 0.3;
    world = build_world(scene);
    for (std::size_t i = 0; i < nodes(); ++i)
      rest.push_back({world->column<Position<TwoD>>().lanes()[2 * i][0],
                      world->column<Position<TwoD>>().lanes()[2 * i + 1][0]});
  }
  std::size_t nodes() const { return world->column<Position<TwoD>>().table.rows; }
  // `gap` m between the ends, negative where they overlap.
  void bend(double gap) {
    const double radius = length / (2 * std::numbers::pi);
    for (std::size_t i = 0; i < nodes(); ++i) {
      const double angle = rest[i][0] / length * (2 * std::numbers::pi - gap / radius);
      const double r = radius - rest[i][1];
      world->column<Position<TwoD>>().lanes()[2 * i][0] = r * std::sin(angle);
      world->column<Position<TwoD>>().lanes()[2 * i + 1][0] = -r * std::cos(angle);
    }
  }

  static constexpr double length = 80e-3;
  std::unique_ptr<World> world;
  std::vector<Point> rest;
};

TEST(SelfContact, EndsOfABentBarPushEachOtherApart) {
  BentBar bar;
  Contacts contacts(*bar.world);
  bar.bend(0.1e-3);  // near, and seen from outside
  contacts.update();
  EXPECT_EQ(contacts.energy(), 0);
  bar.bend(-2e-6);
  contacts.update();
  ASSERT_GT(contacts.energy(), 0);
  const auto& f = bar.world->column<ContactForce<TwoD>>();
  const auto& x = bar.world->column<Position<TwoD>>();
  double sum_x = 0, sum_y = 0, moment = 0, size = 0;
  for (std::size_t i = 0; i < f.table.rows; ++i) {
    const double fx = f.lanes()[2 * i][0], fy = f.lanes()[2 * i + 1][0];
    sum_x += fx;
    sum_y += fy;
    moment += x.lanes()[2 * i][0] * fy - x.lanes()[2 * i + 1][0] * fx;
    size += std::hypot(fx, fy);
  }
  EXPECT_NEAR(sum_x, 0, 1e-12 * size);
  EXPECT_NEAR(sum_y, 0, 1e-12 * size);
  EXPECT_NEAR(moment, 0, 1e-12 * size * bar.length);
  // Both ends push over their height, each with half of the springs of two bodies.
  const double h = 1e-8;
  bar.bend(-2e-6 + h);
  contacts.update();
  const double less = contacts.energy();
  bar.bend(-2e-6 - h);
  contacts.update();
  EXPECT_GT(contacts.energy(), less);
}

// A thin strip bent to a drop, whose legs lie beside each other: a leg's own back face is nearer to it than the other
// leg until they meet.
class Drop {
 public:
  Drop() {
    Scene scene;
    scene.materials = {steel()};
    scene.particles = {
        {"strip", 0, RectangleOutline{length, thickness}, RectangleMesh{80, 1}, false, 0, {}}};
    BodySpec strip, far;
    far.position = Vec3(0, 0.2, 0);
    scene.bodies = {strip, far};
    scene.stages.emplace_back().duration = 1e-3;
    scene.contact.skin = 4;
    world = build_world(scene);
    for (std::size_t i = 0; i < world->column<Position<TwoD>>().table.rows; ++i)
      rest.push_back({world->column<Position<TwoD>>().lanes()[2 * i][0],
                      world->column<Position<TwoD>>().lanes()[2 * i + 1][0]});
  }
  // Round a circle by 150 degrees to each side of the bottom, back by 60, and straight on, `gap` m between the legs.
  void bend(double gap) {
    constexpr double pi = std::numbers::pi, big = 4e-3;
    const double small = big - thickness - gap, first = big * 5 * pi / 6, second = small * pi / 3;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const double side = rest[i][0] < 0 ? -1 : 1, way = std::abs(rest[i][0]);
      const double round = std::min(way, first) / big;
      const double back = std::clamp((way - first) / small, 0.0, pi / 3);
      const double angle = round - back, on = std::max(0.0, way - first - second);
      const double cx =
          big * std::sin(round) - small * (std::sin(5 * pi / 6 - back) - std::sin(5 * pi / 6));
      const double cy =
          -big * std::cos(round) + small * (std::cos(5 * pi / 6 - back) - std::cos(5 * pi / 6));
      const double x = cx + on * std::cos(angle) - rest[i][1] * std::sin(angle);
      world->column<Position<TwoD>>().lanes()[2 * i][0] = side * x;
      world->column<Position<TwoD>>().lanes()[2 * i + 1][0] =
          cy + on * std::sin(angle) + rest[i][1] * std::cos(angle);
    }
  }

  static constexpr double length = 80e-3, thickness = 0.3e-3;
  std::unique_ptr<World> world;
  std::vector<Point> rest;
};

TEST(SelfContact, ThinLegsMeetAlthoughTheirFarSidesAreNearer) {
  Drop drop;
  Contacts contacts(*drop.world);
  for (const double gap : {0.6e-3, 0.4e-3, 0.2e-3, 0.01e-3}) {
    drop.bend(gap);
    contacts.update();
    EXPECT_EQ(contacts.energy(), 0) << gap;
  }
  drop.bend(-2e-6);
  contacts.update();
  EXPECT_GT(contacts.energy(), 0);
  EXPECT_GE(drop.world->resource<Totals>().touching, 2 * 25);  // edges that lie beside each other
  drop.bend(0.01e-3);
  contacts.update();
  EXPECT_EQ(contacts.energy(), 0);
}

TEST(SelfContact, TheFarSideOfAThinPartIsNotTouched) {
  Scene scene;
  scene.materials = {steel()};
  scene.particles = {
      {"strip", 0, RectangleOutline{10e-3, 0.1e-3}, RectangleMesh{20, 1}, false, 0, {}}};
  BodySpec one, other;
  other.position = Vec3(0, 1e-3, 0);
  scene.bodies = {one, other};
  scene.stages.emplace_back().duration = 1e-3;
  const auto world = build_world(scene);
  Contacts contacts(*world);
  contacts.update();
  EXPECT_EQ(contacts.energy(), 0);
  auto& x = world->column<Position<TwoD>>();
  for (std::size_t i = 0; i < x.table.rows; ++i) x.lanes()[2 * i + 1][0] *= 0.2;  // squeezed flat
  contacts.update();
  EXPECT_EQ(contacts.energy(), 0);
}

}  // namespace
}  // namespace pulvis
