// Runs with bonds in three dimensions: strength and fracture energy of a glued cylinder, a glued body that flies and turns,
// balls that weld under pressure.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <regex>
#include <string>

#include "scenes/results/bond_results.hpp"
#include "scenes/results/state_hash.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

// ---- two cylinders, end to end --------------------------------------------------------------------------
constexpr double gap = 12e-6;  // m, across which they are glued: the end faces are flat to 10 um

// Of 1 mm; their meshes do not match. `motion`: what is more of each body.
std::string cylinders(double first, const std::string& material,
                      const std::array<std::string, 2>& motion) {
  std::string text = fmt::format(R"(
family = "compaction"
dimension = 3
[[material]]
name = "stone"
density = "2000 kg/m^3"
youngs_modulus = "20 GPa"
poissons_ratio = 0.0
{}
)",
                                 material);
  for (int i = 0; i < 2; ++i)
    text += fmt::format(R"(
[[particle]]
name = "p{0}"
material = "stone"
shape = "cylinder"
diameter = "1 mm"
height = "1 mm"
rounding = "0.05 mm"
mesh = {{ divisions = {1}, rings = 2, axial_divisions = 6, grid = "extruded" }}
[[body]]
particle = "p{0}"
position = ["0 mm", "0 mm", "{2} mm"]
{3}
)",
                        i, 3 + i, 1e3 * first + i * (1 + 1e3 * gap),
                        motion.at(static_cast<std::size_t>(i)));
  return text;
}
std::string glue(const std::string& other, const char* strength, const char* energy) {
  return fmt::format(R"(
[[bond]]
between = ["stone", "{}"]
origin = "initial"
strength = "{}"
fracture_energy = "{}"
reach = 0.3
)",
                     other, strength, energy);
}

// The upper platen moves by 20 um: along the axis, or across.
Experiment torn_apart(bool across) {
  const std::string damping = "[material.damping]\nmass_proportional = \"300000 1/s\"\n";
  std::string text = cylinders(0.5e-3, damping, {});
  for (const auto& [name, z, normal] : {std::tuple("bottom", -gap, 1), {"top", 2e-3 + 2 * gap, -1}})
    text += fmt::format(
                "[[tool]]\nname = \"{0}\"\nshape = \"plane\"\npoint = [\"0 mm\", \"0 mm\", \"{1} "
                "mm\"]\nnormal = [0, 0, {2}]\n",
                name, 1e3 * z, normal) +
            glue(name, "200 MPa", "20 kJ/m^2");
  text += glue("stone", "10 MPa", "50 J/m^2");
  text += fmt::format(R"(
[[stage]]
name = "pull"
kind = "unload"
duration = "60 us"
[[stage.move]]
tool = "top"
displacement = ["{}", "0 mm", "{}"]
)",
                      across ? "0.03 mm" : "0 mm", across ? "0 mm" : "0.02 mm");
  return Experiment(own_scene(text, {"contact.stiffness=10"}));
}

struct Torn {
  double largest = 0;  // N, on the upper platen
  double area = 0;     // m^2, of the glue
  double fracture = 0, crack_area = 0, fragments = 0, balance = 0;
};
Torn tear(bool across) {
  Experiment e = torn_apart(across);
  Torn torn;
  e.run(1000, [&] {
    const double force = e.value(across ? "tool/top/force_x" : "tool/top/force_z");
    torn.largest = std::max(torn.largest, std::abs(force));
    torn.balance = std::max(torn.balance, std::abs(e.value("energy/balance")));
  });
  torn.fracture = e.value("energy/fracture");
  torn.crack_area = e.value("bonds/crack_area");
  torn.fragments = e.value("bonds/fragments");
  return torn;
}

TEST(BondsInSpace, GluedCylindersBreakAtTheStrengthWithTheEnergyOfTheGlue) {
  for (const bool across : {false, true}) {
    SCOPED_TRACE(across);
    const Torn torn = tear(across);
    EXPECT_EQ(torn.fragments, 2);
    // The end face, up to the rounded rim.
    const double face = 0.25 * std::numbers::pi * 0.95e-3 * 0.95e-3;
    EXPECT_NEAR(torn.crack_area, face, 0.05 * face);
    // In shear one edge is pressed: what its bonds store is dissipated where contact replaces them.
    EXPECT_NEAR(torn.fracture, 50 * torn.crack_area, (across ? 0.01 : 1e-3) * 50 * torn.crack_area);
    EXPECT_NEAR(torn.largest, 10e6 * torn.crack_area, 0.1 * 10e6 * torn.crack_area);
    EXPECT_LT(torn.balance, 1e-3 * torn.fracture);
  }
}

// Momentum and energy of a glued body that flies and tumbles: as of one in one piece.
TEST(BondsInSpace, AGluedBodyKeepsItsMomentumAndEnergy) {
  const auto moving = [](double side) {
    return fmt::format(
        "velocity = [\"3 m/s\", \"{} m/s\", \"0 m/s\"]\nangular_velocity = [\"10000 rad/s\", \"0 "
        "rad/s\", \"20000 rad/s\"]",
        side);
  };
  const double half = 0.5e-3 + 0.5 * gap, side = 1e4 * half;
  Experiment e(own_scene(cylinders(-half, "", {moving(side), moving(-side)}) +
                         glue("stone", "100 MPa", "2 kJ/m^2") + "[contact]\nfriction = 0.3\n" +
                         "[[stage]]\nname = \"turn\"\nkind = \"settle\"\nduration = \"40 us\"\n"));
  std::vector<double> first, last;
  double balance = 0;
  e.run(200, [&] {
    last = e.results.momentum();
    if (first.empty()) first = last;
    balance = std::max(balance, std::abs(e.value("energy/balance")));
  });
  for (std::size_t k = 0; k < 6; ++k) {
    const double scale = k < 3 ? first[0] : std::abs(first[3]) + std::abs(first[5]);
    EXPECT_NEAR(last[k], first[k], 1e-9 * scale) << k;
  }
  EXPECT_LT(balance, 1e-6 * e.value("energy/kinetic"));
  EXPECT_EQ(e.value("bonds/crack_area"), 0);
  EXPECT_GT(e.value("energy/bonds"), 0);
}

// Coarse meshes: the smooth surfaces of the end faces overlap, although the cylinders only touch.
TEST(BondsInSpace, WhatOverlapsAtTheStartIsGluedAndAtRest) {
  std::string text = cylinders(-0.5e-3, "", {});
  text.replace(text.rfind("position"), std::string::npos,
               "position = [\"0 mm\", \"0 mm\", \"0.5 mm\"]\n");
  text = std::regex_replace(text, std::regex("mesh = [^\n]*"), "mesh = { divisions = 4 }");
  text += R"(
[[bond]]
between = ["stone", "stone"]
origin = "initial"
strength = "10 MPa"
fracture_energy = "50 J/m^2"
[[stage]]
name = "rest"
kind = "settle"
duration = "2 us"
)";
  Experiment e(own_scene(text));
  double contact = 0, crack = 0;
  e.run(20, [&] {
    contact = std::max(contact, e.value("energy/contact"));
    crack = std::max(crack, e.value("bonds/crack_area"));
  });
  const double section = 0.25 * std::numbers::pi * 1e-6;
  EXPECT_GT(e.value("bonds/area"), 0.7 * section);
  EXPECT_EQ(crack, 0);
  EXPECT_LT(contact, 1e-9 * 10e6 * section * 1e-3);  // J, of the strength over the height
  EXPECT_LT(e.value("energy/kinetic"), 1e-9 * 10e6 * section * 1e-3);
}

// ---- cold welding ------------------------------------------------------------------------------------------
// Two copper balls and two platens that weld to each other: pressed, then pulled apart.
std::string welded_balls() {
  std::string text = R"(
family = "compaction"
dimension = 3
material = [{ name = "cu", library = "Cu-OFHC" }]
particle = [{ name = "ball", material = "cu", shape = "sphere", diameter = "1 mm", mesh = { divisions = 4, rings = 1 } }]
body = [{ particle = "ball", position = ["0 mm", "0 mm", "0.5 mm"] }, { particle = "ball", position = ["0 mm", "0 mm", "1.5 mm"] }]
contact = { friction = 0.2, damping = 0.1 }
[[tool]]
name = "bottom"
shape = "plane"
point = ["0 mm", "0 mm", "0 mm"]
normal = [0, 0, 1]
[[tool]]
name = "top"
shape = "plane"
point = ["0 mm", "0 mm", "2 mm"]
normal = [0, 0, -1]
)";
  for (const auto& [other, growth, strength, energy] :
       {std::tuple("cu", 0.2, 60, 200), {"top", 0.4, 150, 2000}, {"bottom", 0.4, 150, 2000}})
    text += fmt::format(
        "[[bond]]\nbetween = [\"cu\", \"{}\"]\norigin = \"pressed\"\nthreshold = \"20 "
        "MPa\"\ngrowth = {}\nstrength = \"{} MPa\"\nfracture_energy = \"{} J/m^2\"\n",
        other, growth, strength, energy);
  for (const auto& [name, kind, z] :
       {std::tuple("press", "compact", "-0.1 mm"), {"pull", "unload", "0.08 mm"}})
    text += fmt::format(
        "[[stage]]\nname = \"{}\"\nkind = \"{}\"\nduration = \"60 us\"\n[[stage.move]]\ntool "
        "= \"top\"\ndisplacement = [\"0 mm\", \"0 mm\", \"{}\"]\n",
        name, kind, z);
  return text;
}

TEST(BondsInSpace, BallsWeldUnderPressureAndArePulledApart) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2}) {
    Experiment e(own_scene(welded_balls()), threads);
    double pull = 0, joined = 2, welded = 0, balance = 0;
    e.run(60, [&] {
      pull = std::max(pull, -e.value("tool/top/force_z"));
      joined = std::min(joined, e.value("bonds/fragments"));
      welded = std::max(welded, e.value("bonds/area"));
      balance = std::max(balance, std::abs(e.value("energy/balance")));
    });
    EXPECT_GT(pull, 1);  // N: 60 MPa on the contact of the balls is up to 3 N
    EXPECT_LT(pull, 3);
    EXPECT_EQ(joined, 1);
    EXPECT_EQ(e.value("bonds/fragments"), 2);
    EXPECT_GT(e.value("bonds/area"), 0);  // to the platens
    EXPECT_LT(balance, 1e-4 * e.value("energy/external"));
    // The crack between the balls has dissipated 200 J/m^2 where the weld had its full strength, less elsewhere.
    const double tough = 200 * e.value("bonds/crack_area");
    EXPECT_LT(bond_findings(e.simulation.world())->crack_energy, tough);
    EXPECT_GT(bond_findings(e.simulation.world())->crack_energy, 0.5 * tough);
    hashes.push_back(state_hash(e.simulation.world()));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace pulvis
