// Polyline tools and constraints: against planes, balances of forces and closed forms.
#include <gtest/gtest.h>

#include <bit>
#include <numbers>

#include "components/body.hpp"
#include "components/surface.hpp"
#include "scenes/tools/die_cell.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

constexpr double youngs = 200e9, poisson = 0.3;

const std::string steel = R"(family = "compaction"
title = "tools"
[[material]]
name = "steel"
density = "7850 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
)";

Scene scene_of(const std::string& text) {
  return load_scene_text(steel + text, "tools.toml").scene;
}

struct Force {
  double x = 0, y = 0;
  double size() const { return std::hypot(x, y); }
};

// On a tool, from the rows that push it towards -x or +x.
Force flank_force(const Experiment& e, int tool, bool to_the_left) {
  const auto& pair = e.column<ContactPair<ToolContact>>();
  const auto& touches = e.column<ContactTouches<ToolContact>>();
  const auto& force = e.column<PointForce<ToolContact>>();
  Force sum;
  for (std::size_t r = 0; r < pair.table.rows; ++r) {
    if (pair.values()[3 * r + 2] != tool || touches.values()[r] == 0) continue;
    for (std::size_t g = 0; g < edge_points; ++g) {
      const double x = -force.values()[8 * r + 2 * g], y = -force.values()[8 * r + 2 * g + 1];
      if ((x < 0) != to_the_left) continue;
      sum.x += x;
      sum.y += y;
    }
  }
  return sum;
}

// ---- polylines ----------------------------------------------------------------------------------
TEST(Groove, FlanksBearTheForcesOfAWedge) {
  Experiment e("basic/groove-wedge.toml");
  const double sine = std::sin(15 * std::numbers::pi / 180);
  double lid = 0, left = 0, right = 0;
  int resting = 0;
  e.run(140, [&] {
    if (e.simulation.clock().time < 0.62e-3) return;
    lid += e.value("tool/lid/force_y");
    left += flank_force(e, 0, true).size();
    right += flank_force(e, 0, false).size();
    ++resting;
  });
  ASSERT_GT(resting, 10);
  ASSERT_GT(lid / resting, 100);
  EXPECT_NEAR(left / lid * 2 * sine, 1, 0.01);
  EXPECT_NEAR(right / lid * 2 * sine, 1, 0.01);
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
}

// Each flank alone: the force is normal to it.
TEST(Groove, FrictionlessFlanksPushAlongTheirNormals) {
  Experiment e("basic/groove-wedge.toml", {"stage[0].duration=0.1 ms"});
  e.run(20);
  const Force left = flank_force(e, 0, true);
  ASSERT_GT(left.size(), 10);
  EXPECT_NEAR(left.y / left.x, std::tan(15 * std::numbers::pi / 180), 1e-9);
}

const std::string disc_on = R"(
[[particle]]
name = "disc"
material = "steel"
outline = "disc"
diameter = "10 mm"
[[body]]
particle = "disc"
position = ["1 mm", "5.05 mm"]
velocity = ["3 m/s", "-5 m/s"]
[[stage]]
name = "fall"
kind = "settle"
duration = "0.05 ms"
[contact]
stiffness = 0.5
friction = 0.3
damping = 0.1
[[tool]]
name = "floor"
)";

TEST(Polyline, OfTwoPointsIsAPlane) {
  Experiment plane(scene_of(disc_on + R"(shape = "plane"
point = ["-3 mm", "-0.5 mm"]
normal = [-0.1, 1])"));
  Experiment line(scene_of(disc_on + R"(shape = "polyline"
points = [["-3 mm", "-0.5 mm"], ["-2 mm", "-0.4 mm"]])"));
  double largest = 0;
  for (int i = 1; i <= 50; ++i) {
    for (Experiment* e : {&plane, &line}) {
      e->simulation.run_until(1e-6 * i);
      e->simulation.observe();
      e->results.sample();
      e->simulation.move();
    }
    for (const char* name : {"tool/floor/force_x", "tool/floor/force_y"}) {
      largest = std::max(largest, std::abs(plane.value(name)));
      EXPECT_NEAR(line.value(name), plane.value(name), 1e-12 * largest) << name << i;
    }
  }
  EXPECT_GT(largest, 100);
}

// Points that turn nothing, and corners far away, change nothing.
TEST(Polyline, PointsOnALineChangeNothing) {
  Experiment two(scene_of(disc_on + R"(shape = "polyline"
points = [["-3 mm", "0 mm"], ["3 mm", "0 mm"]])"));
  Experiment many(scene_of(disc_on + R"(shape = "polyline"
points = [["-9 mm", "-3 mm"], ["-5 mm", "0 mm"], ["0.3 mm", "0 mm"], ["1.1 mm", "0 mm"],
          ["1.2 mm", "0 mm"], ["8 mm", "0 mm"], ["9 mm", "4 mm"]]
rounding = "1 mm")"));
  double largest = 0;
  for (int i = 1; i <= 20; ++i) {
    for (Experiment* e : {&two, &many}) {
      e->simulation.run_until(2e-6 * i);
      e->simulation.observe();
      e->results.sample();
      e->simulation.move();
    }
    const double force = two.value("tool/floor/force_y");
    largest = std::max(largest, std::abs(force));
    EXPECT_NEAR(many.value("tool/floor/force_y"), force, 1e-9 * largest) << i;
  }
  EXPECT_GT(largest, 100);
}

// A disc that rolls and bounces over sharp and rounded ridges keeps its energy: every force comes from a
// potential.
TEST(Polyline, RidgesAndValleysKeepEnergy) {
  Experiment e(scene_of(R"([[particle]]
name = "disc"
material = "steel"
outline = "disc"
diameter = "10 mm"
[particle.mesh]
boundary_edges = 80
rings = 3
[[body]]
particle = "disc"
position = ["-3 mm", "7 mm"]
velocity = ["20 m/s", "-4 m/s"]
[[stage]]
name = "fly"
kind = "settle"
duration = "1.5 ms"
[time]
safety = 0.6
[[tool]]
name = "waves"
shape = "polyline"
points = [["-10 mm", "0 mm"], ["0 mm", "0 mm"], ["3 mm", "2 mm"], ["6 mm", "0 mm"], ["9 mm", "2 mm"],
          ["12 mm", "0 mm"], ["15 mm", "3 mm"], ["18 mm", "3 mm"], ["18 mm", "20 mm"]]
rounding = "0.3 mm"
[[tool]]
name = "lid"
shape = "plane"
point = ["0 mm", "14 mm"]
normal = [0, -1])"));
  double maximum = 0;
  e.run(300, [&] { maximum = std::max(maximum, e.results.energies().contact); });
  const double kinetic = 0.5 * 7850 * 25e-6 * std::numbers::pi * 1e-3 * (400 + 16);
  EXPECT_GT(maximum, 0.02 * kinetic);  // it did hit
  EXPECT_LT(e.results.energy_balance_error(), 0.002);
}

const char* const block_on_a_flank = R"([[particle]]
name = "block"
material = "steel"
outline = "rectangle"
width = "4 mm"
height = "8 mm"
[particle.mesh]
columns = 12
rows = 24
[[body]]
particle = "block"
position = ["19.215535459 mm", "7.9223227027 mm"]
angle = "0.19739555984988 rad"
[[tool]]
name = "flank"
shape = "polyline"
points = [["-20 mm", "0 mm"], ["0 mm", "0 mm"], ["40 mm", "8 mm"], ["60 mm", "8 mm"]]
rounding = "1 mm"
[[tool]]
name = "clamp"
shape = "constraint"
low = ["10 mm", "5.8 mm"]
high = ["30 mm", "20 mm"]
holds = "both"
[[stage]]
name = "press"
kind = "compact"
duration = "0.1 ms"
[[stage.move]]
tool = "clamp"
displacement = ["0.0002 mm", "-0.001 mm"]
ramp = 0.5
[[stage]]
name = "drag"
kind = "shear"
duration = "0.5 ms"
[[stage.move]]
tool = "clamp"
displacement = ["0.05 mm", "0.01 mm"]
ramp = 0.2
[contact]
stiffness = 0.5
friction = 0.3
damping = 0.5)";

// F_l / F_n = (s + mu) / (1 - mu s) on a flank of slope s, for a block that is drawn up the flank. It is held
// down to a quarter of its height: one that can bend sticks and slips, as a sliding block does.
TEST(Groove, BlockSlidesUpAFlankAsCoulombSays) {
  const double s = 0.2, mu = 0.3, wanted = (s + mu) / (1 - mu * s);
  Experiment e(scene_of(block_on_a_flank));
  double ahead = 0, down = 0;
  int sliding = 0;
  e.run(300, [&] {
    const double time = e.simulation.clock().time;
    if (time < 0.3e-3 || time > 0.45e-3) return;
    EXPECT_NEAR(-e.value("tool/flank/force_x") / e.value("tool/flank/force_y"), wanted,
                0.005 * wanted)
        << time;
    ahead -= e.value("tool/clamp/force_x");
    down += e.value("tool/clamp/force_y");
    ++sliding;
  });
  ASSERT_GT(sliding, 50);
  ASSERT_GT(down / sliding, 50);
  EXPECT_NEAR(ahead / down, wanted, 0.005 * wanted);
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
}

// Bits of everything that moves, with any number of threads.
TEST(Polyline, ThreadsDoNotChangeABit) {
  const auto bits = [](int threads) {
    Experiment e(
        "basic/groove-wedge.toml",
        {"contact.friction=0.2", "stage[0].duration=0.02 ms",
         "tool.lid.point=[\"0 mm\", \"24.31 mm\"]", "body[0].position=[\"0 mm\", \"19.3186 mm\"]",
         "body[0].velocity=[\"1 m/s\", \"-5 m/s\"]", "tool.lid.point=[\"0 mm\", \"24.32 mm\"]"},
        threads);
    e.simulation.run_steps(500);
    e.simulation.observe();
    std::vector<std::byte> all;
    for (const ColumnBase* c : e.simulation.world().columns())
      all.insert(all.end(), c->data(), c->data() + c->bytes());
    EXPECT_GT(e.simulation.world().resource<Totals>().friction_work, 0);
    return all;
  };
  const auto one = bits(1);
  EXPECT_TRUE(one == bits(2));
  EXPECT_TRUE(one == bits(3));
}

// Derived figures belong to a die of four planes, and to what is in it.
TEST(Polyline, HasNoRelativeDensity) {
  Experiment e("basic/groove-wedge.toml");
  EXPECT_FALSE(die_cell(e.scene));
  Scene die = read_scene(paths::source_dir() + "/scenes/compaction/unit-cell.toml");
  ASSERT_TRUE(die_cell(die));
  die.tools.push_back(die.tools.front());
  die.tools.back().shape = ToolSpec::Shape::constraint;
  EXPECT_TRUE(die_cell(die));  // takes no space
  ToolSpec& platen = die.tools.back();
  platen.shape = ToolSpec::Shape::polyline;
  EXPECT_FALSE(die_cell(die));
  // Unless it begins behind a wall, until that has gone: the left one, at x = 0.
  platen.points = {{-20e-3, 6e-3}, {-1e-3, 6e-3}, {-1e-3, 4e-3}, {-20e-3, 4e-3}};
  EXPECT_TRUE(die_cell(die));
  platen.points[1].x() = 1e-3;
  EXPECT_FALSE(die_cell(die));
  platen.points = {
      {-1e-3, 6e-3}, {-20e-3, 6e-3}, {-20e-3, 4e-3}, {-1e-3, 4e-3}};  // goes on to the right
  EXPECT_FALSE(die_cell(die));
}

// ---- constraints ----------------------------------------------------------------------------------------
TEST(Constraint, BarStretchesAsPlaneStrainSays) {
  Experiment e("basic/tension.toml");
  const double area = 5e-3 * e.scene.thickness, strain = 0.002e-3 / 20e-3;
  const double wanted = youngs / (1 - poisson * poisson) * area * strain;
  int resting = 0;
  e.run(110, [&] {
    if (e.simulation.clock().time < 0.51e-3) return;
    const double left = e.value("tool/left/force_x"), right = e.value("tool/right/force_x");
    EXPECT_NEAR(left / wanted, 1, 1e-3);
    EXPECT_NEAR(right / left, -1, 1e-6);
    EXPECT_NEAR(e.value("tool/middle/force_y") / wanted, 0, 1e-6);
    ++resting;
  });
  ASSERT_GT(resting, 5);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
  // The work of the constraint is the elastic energy.
  EXPECT_NEAR(e.results.energies().external / (0.5 * wanted * 0.002e-3), 1, 1e-3);
}

// Nodes stand where the programme puts them, to round-off, at the end as in between.
TEST(Constraint, NodesFollowTheProgramWithoutDrift) {
  Experiment e("basic/tension.toml");
  const auto& x = e.column<Position<TwoD>>();
  const std::size_t rows = x.table.rows;
  std::vector<std::size_t> right;
  for (std::size_t n = 0; n < rows; ++n)
    if (std::abs(x.lanes()[2 * n][0] - 20e-3) < 1e-9) right.push_back(n);
  ASSERT_EQ(right.size(), 5U);
  e.run(37, [&] {
    const double travel = e.value("tool/right/position_x") - 20e-3;
    for (const std::size_t n : right) EXPECT_NEAR(x.lanes()[2 * n][0], 20e-3 + travel, 1e-16);
  });
  EXPECT_NEAR(e.value("tool/right/position_x"), 20.002e-3, 1e-15);
}

// The node in the middle of an end by a circle instead of a box: the same run.
TEST(Constraint, HoldsWithinARadius) {
  Experiment box("basic/tension.toml");
  Scene scene = box.scene;
  ToolSpec& middle = scene.tools[2];
  middle.radius = 1e-3;  // the next node is 1.25 mm away
  Experiment circle(scene);
  box.run(10);
  circle.run(10);
  EXPECT_EQ(box.column<ConstraintTarget>().table.rows,
            circle.column<ConstraintTarget>().table.rows);
  EXPECT_EQ(box.value("tool/right/force_x"), circle.value("tool/right/force_x"));
  EXPECT_EQ(circle.value("tool/middle/position_x"), middle.point.x());
  middle.radius = 1.25e-3;  // and now it holds the next to the right, above and below
  EXPECT_EQ(Experiment(scene).column<ConstraintTarget>().table.rows,
            box.column<ConstraintTarget>().table.rows + 3);
}

// A square of one element whose corners move outwards: uniform strain e in x and y, U = K e^2 A t with
// K = E / ((1 + nu) (1 - 2 nu)); the radial forces together are dU/du, u = e r.
TEST(Constraint, RadialStretchOfASquare) {
  Experiment e(scene_of(R"([[particle]]
name = "square"
material = "steel"
outline = "rectangle"
width = "2 mm"
height = "2 mm"
[particle.mesh]
columns = 1
rows = 1
[[body]]
particle = "square"
position = ["3 mm", "1 mm"]
[[tool]]
name = "spread"
shape = "constraint"
low = ["2 mm", "0 mm"]
high = ["4 mm", "2 mm"]
holds = "radial"
point = ["3 mm", "1 mm"]
[[stage]]
name = "spread"
kind = "compact"
duration = "0.1 ms"
[[stage.move]]
tool = "spread"
displacement = ["0.0001 mm", "0 mm"]
ramp = 0.5)"));
  e.run(20);
  const double radius = std::sqrt(2.0) * 1e-3, strain = 1e-7 / radius;
  const double force =
      2 * youngs / ((1 + poisson) * (1 - 2 * poisson)) * strain * 4e-6 * e.scene.thickness / radius;
  EXPECT_NEAR(e.value("tool/spread/force_x") / -force, 1, 1e-3);
  EXPECT_EQ(e.value("tool/spread/force_y"), 0);
  EXPECT_LT(e.results.energy_balance_error(), 1e-6);
  const auto& x = e.column<Position<TwoD>>();
  for (std::size_t n = 0; n < 4; ++n)
    EXPECT_NEAR(std::hypot(x.lanes()[2 * n][0] - 3e-3, x.lanes()[2 * n + 1][0] - 1e-3),
                radius + 1e-7, 1e-15);
}

// Constraints stop the ends of a bar that flew: the shock stays in it, and no energy is made or lost. (The last
// step of a run is shorter, which the kinetic energy of the leapfrog shows: not asked here.)
TEST(Constraint, StopsAFlyingBar) {
  Experiment e("basic/tension.toml", {"body[0].velocity=[\"1 m/s\", \"0 m/s\"]"});
  for (int i = 0; i <= 50; ++i) {
    e.simulation.run_until(1e-5 * i);
    e.simulation.observe();
    e.results.sample();
    e.simulation.move();
  }
  EXPECT_GT(e.results.energies().elastic, 0.05 * e.results.energies().kinetic);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
}

TEST(Constraint, ExistsOnlyWhereAsked) {
  Experiment with("basic/tension.toml"), without("basic/groove-wedge.toml");
  EXPECT_TRUE(with.simulation.world().has<ConstraintReaction>());
  EXPECT_FALSE(with.simulation.world().has<ContactPair<ToolContact>>());
  EXPECT_FALSE(with.simulation.world().has<SurfaceRange>());
  EXPECT_FALSE(without.simulation.world().has<ConstraintReaction>());
  EXPECT_TRUE(without.simulation.world().has<SurfaceRange>());
  Experiment planes("compaction/unit-cell.toml");
  EXPECT_FALSE(planes.simulation.world().has<ToolShapes>());
  EXPECT_FALSE(planes.simulation.world().has<SurfaceRange>());
}

}  // namespace
}  // namespace pulvis
