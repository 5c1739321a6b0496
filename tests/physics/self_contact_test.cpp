// One particle that folds onto itself: its parts press on each other, or the run stops and says why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "components/hollow.hpp"
#include "engine/run_failure.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using ::testing::ContainsRegex;

struct Press {
  std::string particle;
  double half = 10;      // mm, from the middle to each of the two planes
  double way = 6;        // mm, of the right one
  double duration = 20;  // ms
  double friction = 0;
  double stiffness = 10;
  double unconverged = 1e-3;  // limits.unconverged_projections
  bool plain = false;         // without inerters, and the longer steps that they allow
};

std::string number(double value) { return std::to_string(value); }

// A jelly between two planes, with contacts stiff enough for it.
Experiment pressed(const Press& press) {
  const auto plane = [&](const char* name, double x, const char* normal) {
    return std::string("[[tool]]\nname = \"") + name + "\"\nshape = \"plane\"\npoint = [\"" +
           number(x) + " mm\", \"0 mm\"]\nnormal = " + normal + "\n\n";
  };
  const std::string plain = press.plain ? "tangential_stiffness = " + number(press.stiffness) +
                                              "\ninertance = 0\n\n[time]\nestimate = \"element\"\n"
                                        : "";
  const std::string text =
      "family = \"compaction\"\n\n[[material]]\nname = \"jelly\"\ndensity = \"1000 kg/m^3\"\n"
      "youngs_modulus = \"100 kPa\"\npoissons_ratio = 0.3\n\n[[particle]]\nname = \"one\"\n"
      "material = \"jelly\"\n" +
      press.particle + "\n[[body]]\nparticle = \"one\"\nposition = [\"0 mm\", \"0 mm\"]\n\n" +
      plane("left", -press.half, "[1, 0]") + plane("right", press.half, "[-1, 0]") +
      "[contact]\nstiffness = " + number(press.stiffness) +
      "\nfriction = " + number(press.friction) + "\n" + plain +
      "\n[[stage]]\nname = \"press\"\nkind = \"compact\"\nduration = \"" + number(press.duration) +
      " ms\"\n[[stage.move]]\ntool = \"right\"\ndisplacement = [\"-" + number(press.way) +
      " mm\", \"0 mm\"]\nramp = 0.3\n\n[limits]\nunconverged_projections = " +
      number(press.unconverged) + "\n";
  return Experiment(load_scene_text(text, "pressed.toml").scene);
}

std::string polygon(const std::string& corners, int edges) {
  return "outline = \"polygon\"\ncorners = [" + corners +
         "]\nrounding = \"0.5 mm\"\nmesh = {boundary_edges = " + std::to_string(edges) + "}\n";
}
std::string notched(int edges) {
  return polygon(R"(["-10 mm", "-10 mm"], ["10 mm", "-10 mm"], ["10 mm", "10 mm"],
    ["2 mm", "10 mm"], ["0 mm", "0 mm"], ["-2 mm", "10 mm"], ["-10 mm", "10 mm"])",
                 edges);
}
constexpr const char* ring = R"(outline = "ring"
diameter = "20 mm"
hole = "17 mm"
mesh = {boundary_edges = 80, rings = 2}
)";

// What stopped the run; nothing where it reached its end.
std::string run(Experiment& e) {
  return message_of<RunFailure>([&] { e.run(20); });
}

std::vector<Point> outline(Experiment& e) {
  const auto& x = e.column<Position<TwoD>>();
  const Bodies& bodies = e.simulation.world().resource<Bodies>();
  const int slot = bodies.slot_of_number[0];
  std::vector<Point> points;
  for (int i = 0; i < bodies.shape_of_slot(slot).boundary_nodes; ++i)
    points.push_back({x.lanes()[2 * i][slot], x.lanes()[2 * i + 1][slot]});
  return points;
}

// By how much flanks of an outline that face each other across x are past each other at a height: of two crossings
// of a level that follow each other from left to right, the first enters the particle, the second leaves it. m.
double deepest_swap(const std::vector<Point>& points, double y) {
  struct Crossing {
    double x;
    bool enters;
  };
  std::vector<Crossing> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point &a = points[i], &b = points[(i + 1) % points.size()];
    if ((a[1] > y) != (b[1] > y))
      all.push_back({a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]), b[1] < a[1]});
  }
  std::ranges::sort(all, {}, &Crossing::x);
  double deepest = 0;
  int times = 0;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    times += all[i].enters ? 1 : -1;
    if (times > 1) deepest = std::max(deepest, all[i + 1].x - all[i].x);
  }
  return deepest;
}

double deepest_swap(const std::vector<Point>& points) {
  double deepest = 0;
  for (int i = -100; i < 140; ++i) deepest = std::max(deepest, deepest_swap(points, i * 0.1e-3));
  return deepest;
}

struct NotchCase {
  int edges;
  double duration, friction;
};
class Notch : public ::testing::TestWithParam<NotchCase> {};

// Its sides touch from the lips to the root, where the edges that meet are neighbours.
TEST_P(Notch, SidesPressOnEachOther) {
  const NotchCase c = GetParam();
  Experiment e =
      pressed({.particle = notched(c.edges), .duration = c.duration, .friction = c.friction});
  double open = 0;  // contacts, before the planes have closed the notch
  e.run(20, [&] {
    EXPECT_LT(deepest_swap(outline(e)), 0.15e-3) << e.simulation.clock().time;
    if (e.value("tool/right/position_x") > 8e-3) open = std::max(open, e.value("contacts"));
  });
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
  EXPECT_GT(e.value("contacts"), open);
}

INSTANTIATE_TEST_SUITE_P(Cases, Notch,
                         ::testing::Values(NotchCase{84, 6, 0}, NotchCase{96, 6, 0},
                                           NotchCase{96, 6, 0.5}, NotchCase{192, 6, 0}));

// Slowly: what one plane presses with, the other bears; and a closed notch bears as if it were none.
TEST(SelfContact, AClosedNotchPassesOnTheForce) {
  Experiment e = pressed({.particle = notched(96), .duration = 60});
  EXPECT_EQ(run(e), "");
  const double left = -e.value("tool/left/force_x"), right = e.value("tool/right/force_x");
  EXPECT_NEAR(left, right, 0.01 * right);
  EXPECT_LT(e.results.energy_balance_error(), 1e-4);
}

// Deeper than the skin of the search, flat flanks stay in contact.
TEST(SelfContact, SoftSidesOfANotchStayInContact) {
  Experiment e = pressed({.particle = notched(192), .duration = 6, .stiffness = 0.5});
  EXPECT_EQ(run(e), "");
  EXPECT_GT(e.value("penetration"), 0.2);
  EXPECT_LT(e.results.energy_balance_error(), 1e-4);
}

// Slowly enough for the arms: in half the time they snap, and the error of the energies is anything from 4e-4 to 7e-3.
TEST(SelfContact, ArmsOfAStarPressOnEachOther) {
  Experiment e = pressed({.particle = polygon(R"(["7.071 mm", "7.071 mm"], ["0 mm", "4 mm"],
    ["-7.071 mm", "7.071 mm"], ["-4 mm", "0 mm"], ["-7.071 mm", "-7.071 mm"], ["0 mm", "-4 mm"],
    ["7.071 mm", "-7.071 mm"], ["4 mm", "0 mm"])",
                                              160),
                          .half = 7.2,
                          .way = 8,
                          .duration = 16});
  e.run(20, [&] { EXPECT_LT(deepest_swap(outline(e)), 0.15e-3); });
  EXPECT_LT(e.results.energy_balance_error(), 1e-4);
}

// As the notch begins to close, one point in a million swings between two that are as near to it.
TEST(SelfContact, StopsWhereNoClosestPointMayBeMissed) {
  Experiment e =
      pressed({.particle = notched(120), .friction = 0.3, .unconverged = 0, .plain = true});
  EXPECT_THAT(run(e),
              ContainsRegex("^edge_contact: particle 0, edge [0-9]+ against particle 0: the "
                            "closest point was not found by .* as for 1 of [0-9]+ "
                            "points so far.*allowed 0 .limits.unconverged_projections"));
}

// Nothing touches in the hole: its faces would go through each other.
TEST(SelfContact, ARingPressedFlatIsStopped) {
  Experiment e = pressed({.particle = ring, .way = 18});
  EXPECT_THAT(run(e), ContainsRegex("^outline_health: particle 0 has penetrated itself: node "
                                    "[0-9]+, of its hole, is .* at step [0-9]+, t = .* s; allowed "
                                    "0 m \\(holes have no contact"));
  EXPECT_LT(e.value("tool/right/position_x"), -1e-3);  // not before its walls meet
}

// A bar bent by hand to a ring, whose ends have gone through each other where no contact was looked for.
TEST(SelfContact, EndsThatWentThroughEachOtherAreFound) {
  constexpr double length = 40e-3;
  for (const double gap : {0.5e-3, -0.05e-3, -2e-3}) {
    Experiment e =
        pressed({.particle = "outline = \"rectangle\"\nwidth = \"40 mm\"\nheight = \"2 mm\"\n"
                             "mesh = {columns = 40, rows = 4}\n",
                 .half = 20.1});
    auto& x = e.simulation.world().column<Position<TwoD>>();
    const double radius = length / (2 * std::numbers::pi);
    for (std::size_t i = 0; i < x.table.rows; ++i) {
      Lane &px = x.lanes()[2 * i], &py = x.lanes()[2 * i + 1];
      const double angle = px[0] / length * (2 * std::numbers::pi - gap / radius),
                   r = radius - py[0];
      px[0] = r * std::sin(angle);
      py[0] = -r * std::cos(angle);
    }
    if (gap > -1e-3) {
      EXPECT_NO_THROW(e.simulation.observe()) << gap;
    } else {
      EXPECT_THROW(e.simulation.observe(), RunFailure) << gap;
    }
  }
}

// Rows of an outline against itself are there where it can fold, and only there.
TEST(SelfContact, IsLookedForWhereOutlinesCanFold) {
  const auto looked_for = [](const std::string& particle) {
    Experiment e = pressed({.particle = particle, .half = 20.1});
    return e.simulation.world().has<ContactPair<Contact>>();
  };
  EXPECT_TRUE(looked_for(notched(96)));
  EXPECT_TRUE(looked_for("outline = \"rectangle\"\nwidth = \"40 mm\"\nheight = \"2 mm\"\n"));
  EXPECT_FALSE(looked_for("outline = \"disc\"\ndiameter = \"10 mm\"\n"));
  EXPECT_FALSE(looked_for("outline = \"rectangle\"\nwidth = \"10 mm\"\nheight = \"5 mm\"\n"));
  Experiment disc = pressed({.particle = "outline = \"disc\"\ndiameter = \"10 mm\"\n"});
  EXPECT_FALSE(disc.simulation.world().has<Hollows>());
  EXPECT_TRUE(pressed({.particle = ring}).simulation.world().has<Hollows>());
}

}  // namespace
}  // namespace pulvis
