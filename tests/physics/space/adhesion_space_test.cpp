// Surfaces that attract each other in three dimensions. The law's traction is sigma (1 - 3 x^2 + 2 x^3), x = gap/range,
// sigma = 2 w/range. A ball at a gap s from a plane is then pulled by 2 pi R times its integral over the gap from s to the
// range (Derjaguin 1934; exact for a ball, whose area per height is 2 pi R): 2 pi R w in contact.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

constexpr double radius = 0.5e-3, range = 20e-6, work = 50;

// J/m^2, still to be spent at this gap.
double work_left(double gap) {
  const double x = gap / range;
  return x < 1 ? 2 * work * (0.5 - x + x * x * x - 0.5 * x * x * x * x) : 0;
}

// J, to separate two balls: the work left over the plane in between, on which the gap is d = gap + r^2/R: pi R int w dd.
double energy_of_two(double gap) {
  constexpr int steps = 1000;
  const double width = std::max(range - gap, 0.0) / steps;
  double energy = 0;
  for (int i = 0; i < steps; ++i)
    energy += std::numbers::pi * radius * work_left(gap + (i + 0.5) * width) * width;
  return energy;
}

// One ball, or a second one above it; positions in um.
std::string balls(const std::vector<double>& heights, const std::string& more, int divisions = 10) {
  std::string text = std::string(R"(
family = "compaction"
dimension = 3
material = [{ name = "steel", density = "7990 kg/m^3", youngs_modulus = "200 GPa", poissons_ratio = 0.3 }]
particle = [{ name = "ball", material = "steel", shape = "sphere", diameter = "1 mm", mesh = { divisions = )") +
                     std::to_string(divisions) + R"(, rings = 1 } }]
)";
  for (const double z : heights)
    text += fmt::format(
        "[[body]]\nparticle = \"ball\"\nposition = [\"0 um\", \"0 um\", \"{} um\"]\n", z);
  return text + more;
}
std::string attraction(const std::string& other) {
  return "[[bond]]\nbetween = [\"steel\", \"" + other +
         "\"]\norigin = \"adhesion\"\nwork = \"50 J/m^2\"\nrange = \"20 um\"\n";
}
constexpr const char* plane =
    "[[tool]]\nname = \"wall\"\nshape = \"plane\"\npoint = [\"0 um\", \"0 um\", \"0 um\"]\nnormal "
    "= [0, 0, 1]\n";
std::string settle(const char* duration) {
  return std::string("[[stage]]\nname = \"rest\"\nkind = \"settle\"\nduration = \"") + duration +
         "\"\n";
}

TEST(AdhesionInSpace, PullsABallToAPlaneByDerjaguinsForce) {
  for (const double gap : {0.5e-6, 5e-6, 10e-6, 15e-6, 21e-6}) {
    SCOPED_TRACE(gap);
    Experiment e(
        own_scene(balls({1e6 * (radius + gap)}, plane + attraction("wall") + settle("0.01 ns"))));
    e.run(1);
    const double law = 2 * std::numbers::pi * radius * work_left(gap);
    // The smooth surface of this mesh is off the ball by less than 0.1 um.
    EXPECT_NEAR(-e.value("tool/wall/force_z"), -law, 0.015 * 2 * std::numbers::pi * radius * work);
  }
}

TEST(AdhesionInSpace, PullsTwoBallsWithTheEnergyOfTheLaw) {
  for (const double gap : {1e-6, 8e-6, 16e-6, 21e-6}) {
    SCOPED_TRACE(gap);
    Experiment e(
        own_scene(balls({0, 1e6 * (2 * radius + gap)}, attraction("steel") + settle("0.01 ns"))));
    e.run(1);
    EXPECT_NEAR(e.value("energy/contact"), -energy_of_two(gap), 0.03 * energy_of_two(0));
  }
}

// Two touching balls fly apart, each with half of the given share of the speed that the law's energy allows to escape.
struct Flight {
  double kinetic = 0, at_start = 0;  // J
  double contact = 0;                // J, at the end
  double balance = 0;                // of the work of adhesion, largest
};
Flight fly_apart(double share) {
  const double mass = 7990.0 * 4 / 3 * std::numbers::pi * radius * radius * radius;
  const double escape = std::sqrt(4 * energy_of_two(0) / mass);  // of a reduced mass of m/2
  Experiment e(own_scene(balls({},
                               fmt::format(R"(
[[body]]
particle = "ball"
position = ["0 um", "0 um", "0 um"]
velocity = ["0 m/s", "0.1 m/s", "{0} m/s"]
[[body]]
particle = "ball"
position = ["0 um", "0 um", "1000 um"]
velocity = ["0 m/s", "0.1 m/s", "{1} m/s"]
)",
                                           -0.5 * share * escape, 0.5 * share * escape) +
                                   attraction("steel") + settle("100 us") +
                                   "[time]\nestimate = \"element\"\n",
                               5)));
  Flight flight;
  e.run(1000, [&] {
    if (flight.at_start == 0) flight.at_start = e.value("energy/kinetic");
    flight.balance =
        std::max(flight.balance, std::abs(e.value("energy/balance")) / energy_of_two(0));
  });
  const double together = mass * 0.1 * 0.1;
  flight.at_start -= together;
  flight.kinetic = e.value("energy/kinetic") - together;
  flight.contact = e.value("energy/contact");
  return flight;
}

TEST(AdhesionInSpace, LetsBallsEscapeWithWhatTheWorkOfAdhesionLeaves) {
  const Flight away = fly_apart(1.25);
  EXPECT_EQ(away.contact, 0);
  EXPECT_NEAR(away.kinetic / away.at_start, 1 - 1 / (1.25 * 1.25), 0.02);
  EXPECT_LT(away.balance, 1e-3);
  const Flight bound = fly_apart(0.8);
  EXPECT_LT(bound.contact, 0);
  EXPECT_LT(bound.balance, 1e-3);
}

}  // namespace
}  // namespace pulvis
