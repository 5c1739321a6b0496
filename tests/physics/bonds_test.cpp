// Bonds against laws: a glued bar is a bar, a glued body that turns is a body, glue takes its energy at any mesh and in
// any mode, and nothing depends on threads.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <tuple>

#include "components/bond.hpp"
#include "scenes/results/bond_results.hpp"
#include "scenes/results/state_hash.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/wrong.hpp"
#include "tests/physics/stone_pieces.hpp"

namespace pulvis {
namespace {

// ---- a bar of one piece, or glued from two unlike ones ---------------------------------------------------
std::string bar(bool glued) {
  if (!glued) return piece("whole", 6, 0);
  return piece("left", 2.5, -1.75) + piece("right", 3.5, 1.25) + R"(
[[bond]]
between = ["stone", "stone"]
origin = "initial"
strength = "1 GPa"
fracture_energy = "0.1 MJ/m^2"
)";
}

struct Loading {
  const char* name;
  double x, y;  // um
};

double force_on(bool glued, const Loading& loading) {
  const int last = glued ? 1 : 0;
  const bool bends = loading.name == std::string("bending");
  const std::string grips = bends ? grip("left", 0, {-3.01, -.51, -2.99, -.49}, "y") +
                                        grip("right", last, {2.99, -.51, 3.01, -.49}, "y") +
                                        grip("load", last, {-.01, .49, .01, .51}, "both")
                                  : grip("left", 0, {-3.01, -1, -2.99, 1}, "both") +
                                        grip("load", last, {2.99, -1, 3.01, 1}, "both");
  Experiment e(own_scene(bar_material + bar(glued) + grips +
                         fmt::format(R"(
[[stage]]
name = "load"
kind = "shear"
duration = "0.3 ms"
[[stage.move]]
tool = "load"
displacement = ["{} um", "{} um"]
[[stage]]
name = "rest"
kind = "hold"
duration = "0.15 ms"
)",
                                     loading.x, loading.y)));
  e.run(20);
  EXPECT_LT(e.results.energy_balance_error(), 1e-4);
  return e.value(loading.x != 0 ? "tool/load/force_x" : "tool/load/force_y");
}

TEST(GluedBar, AnswersAsTheWholeBar) {
  for (const Loading& loading : {Loading{"tension", 10, 0}, Loading{"compression", -10, 0},
                                 Loading{"shear", 0, 10}, Loading{"bending", 0, -10}}) {
    const double whole = force_on(false, loading), glued = force_on(true, loading);
    EXPECT_NEAR(glued, whole, 0.01 * std::abs(whole)) << loading.name;
    EXPECT_GT(std::abs(whole), 0.5) << loading.name;
  }
}

// ---- a glued body that turns -------------------------------------------------------------------------------
// Free, about the middle of both: twice round in 2 ms, with what that takes of stress. `glued`: of two halves.
struct Turned {
  double elastic, bonds, kinetic, balance, contacts;
};
Turned turn(bool glued) {
  const double omega = 2 * 2 * std::numbers::pi / 2e-3;
  const auto half = [&](double y) {
    return fmt::format(
        "[[body]]\nparticle = \"half\"\nposition = [\"0 mm\", \"{} mm\"]\nangular_velocity = "
        "\"{:.17g} rad/s\"\nvelocity = [\"{:.17g} m/s\", \"0 m/s\"]\n",
        y, omega, -omega * y * 1e-3);
  };
  std::string text = bar_material;
  text.erase(text.find("[material.damping]"));
  text += fmt::format(
      "[[particle]]\nname = \"half\"\nmaterial = \"stone\"\noutline = \"rectangle\"\nwidth = \"1 "
      "mm\"\nheight = \"{} mm\"\n[particle.mesh]\ncolumns = 10\nrows = {}\n",
      glued ? 1 : 2, glued ? 10 : 20);
  text += glued ? half(-0.5) + half(0.5) : half(0);
  if (glued)
    text +=
        "[[bond]]\nbetween = [\"stone\", \"stone\"]\norigin = \"initial\"\nstrength = \"10 "
        "MPa\"\nfracture_energy = \"20 J/m^2\"\n";
  text += "[[stage]]\nname = \"spin\"\nkind = \"hold\"\nduration = \"2 ms\"\n";
  Experiment e(own_scene(text));
  double elastic = 0, bonds = 0;
  e.run(200, [&] {
    elastic += e.results.energies().elastic / 201;
    bonds += e.results.energies().bonds / 201;
  });
  return {elastic, bonds, e.results.energies().kinetic, e.results.energy_balance_error(),
          e.value("contacts")};
}

TEST(GluedBody, TurnsTwiceWithTheStressOfItsRotationOnly) {
  const Turned whole = turn(false), glued = turn(true);
  // Both ring, each in its own way, with the energy that the rotation stores.
  EXPECT_NEAR(glued.kinetic, whole.kinetic, 2 * whole.elastic);
  EXPECT_NEAR(glued.elastic + glued.bonds, whole.elastic, 0.05 * whole.elastic);
  EXPECT_LT(glued.elastic, 1e-4 * glued.kinetic);
  EXPECT_LT(glued.balance, 1e-7);
  EXPECT_EQ(glued.contacts, 20);  // every point of both sides is still bonded
}

// ---- breaking ----------------------------------------------------------------------------------------------
double spent(const std::vector<std::string>& overrides, const char* scene = "pulled-blocks.toml") {
  Experiment e(std::string("bonds/") + scene, overrides);
  e.run(50);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
  EXPECT_EQ(e.value("bonds/area"), 0);
  EXPECT_NEAR(e.value("bonds/crack_length"), 1e-3, 1e-12);
  return e.value("energy/fracture");
}

TEST(Glue, TakesItsFractureEnergyAtAnyMesh) {
  for (const char* columns : {"5", "8", "10", "17"})
    EXPECT_NEAR(spent({std::string("particle.upper.mesh.columns=") + columns}), 20e-6, 0.2e-6)
        << columns;
  EXPECT_NEAR(spent({}, "sheared-blocks.toml"), 40e-6, 0.4e-6);
}

// Grains that tear open at one end of a boundary are pressed and slide at the other: the narrow phase has the free points
// of a row, and leaves the friction springs of its bonded ones alone.
TEST(Glue, ThatTearsAndSlidesUnderPressureKeepsTheEnergyBalance) {
  Experiment e("studies/scenes/crushed-particle.toml",
               {"seed=19", "particle.crystal.diameter=\"6 mm\"",
                "particle.crystal.grains.number=13", "tool.bottom.point=[\"0 mm\", \"-3.003 mm\"]",
                "tool.top.point=[\"0 mm\", \"3.003 mm\"]", "stage.crush.duration=\"0.18 ms\"",
                "stage.crush.move.top.displacement=[\"0 mm\", \"-0.045 mm\"]"});
  e.run(200);
  EXPECT_LT(e.results.energy_balance_error(), 0.002);
  EXPECT_GT(e.value("bonds/crack_length"), 6e-3);
}

// ---- results -----------------------------------------------------------------------------------------------
double sum_of_column(const std::vector<std::vector<double>>& rows, std::size_t column) {
  double sum = 0;
  for (const auto& row : rows) sum += row.at(column);
  return sum;
}

// m, of the lines along the bonds.
double sum_of_lengths(const Experiment& e) {
  double sum = 0;
  for (const double length : e.field("bonds/length")) sum += length;
  return sum;
}

TEST(BondResults, CracksAddUpToTheHistory) {
  enum Column { time, x, y, particle, other, bond, length, shear, energy, inside };
  Experiment e("bonds/pulled-blocks.toml");
  ASSERT_EQ(e.results.tables().size(), 1U);
  e.run(50);
  const auto rows = crack_rows(e.simulation.world(), 0);
  ASSERT_EQ(rows.size(), 4U * (10 + 13));
  EXPECT_EQ(rows.front().size(), e.results.tables().front().columns.size());
  EXPECT_NEAR(sum_of_column(rows, length), e.value("bonds/crack_length"), 1e-15);
  EXPECT_NEAR(sum_of_column(rows, energy), e.value("energy/fracture"), 1e-12 * 20e-6);
  for (const auto& row : rows) {
    EXPECT_EQ(row[particle] + row[other], 1);  // from both sides
    EXPECT_EQ(row[inside], 0);                 // between two particles
    EXPECT_LT(row[shear], 1e-6);
    EXPECT_NEAR(row[y], 0.5e-3, 5e-6);
  }
  EXPECT_EQ(crack_rows(e.simulation.world(), 90).size(), 2U);
}

TEST(BondResults, FragmentsComeFromBondsThatBreak) {
  using ::testing::ElementsAre;
  Experiment e("bonds/pulled-blocks.toml");
  std::set<double> fragments, damage;
  e.run(50, [&] {
    fragments.insert(e.value("bonds/fragments"));
    damage.insert(e.value("bonds/damage"));
    EXPECT_EQ(e.value("bonds/largest_fragment"), e.value("bonds/fragments") == 1 ? 1 : 0.5);
    EXPECT_NEAR(sum_of_lengths(e), e.value("bonds/area") / 1e-3, 1e-15);
  });
  EXPECT_THAT(fragments, ElementsAre(1, 2));
  EXPECT_EQ(*damage.begin(), 0);
  EXPECT_EQ(*damage.rbegin(), 1);
  EXPECT_THAT(e.field("fragment"), ElementsAre(0, 1));
  EXPECT_THAT(e.field("fragments/number"), ElementsAre(0, 1));
  EXPECT_THAT(e.field("damage"), ElementsAre(1, 1));
  EXPECT_THAT(e.field("parent"), ElementsAre(0, 1));
  const auto start = e.field("cracks/start"), end = e.field("cracks/end");
  ASSERT_EQ(start.size(), 2 * 92U);
  double length = 0;  // along the broken edges, of both sides
  for (std::size_t i = 0; i < start.size(); i += 2)
    length += 0.5 * std::hypot(start[i] - end[i], start[i + 1] - end[i + 1]);
  EXPECT_NEAR(length, 1e-3, 1e-6);
  const auto found = bond_findings(e.simulation.world());
  EXPECT_EQ(found->made, 92);
  EXPECT_EQ(found->broken, 92);
  EXPECT_LT(*found->shear_share, 1e-6);
}

// Numbers that can be looked up among the particles, whatever is whole and whatever is of grains.
TEST(BondResults, ParentsAreTheLowestNumbersOfTheirGrains) {
  std::string text = bar_material;
  for (const char* grains : {"", "grains = { number = 3 }\n"})
    text += fmt::format(
        "[[particle]]\nname = \"disc{}\"\nmaterial = \"stone\"\noutline = \"disc\"\ndiameter = "
        "\"1 mm\"\n{}",
        *grains == 0 ? "" : "-of-grains", grains);
  double x = 0;
  for (const char* of : {"", "-of-grains", "", "-of-grains", ""})
    text += fmt::format("[[body]]\nparticle = \"disc{}\"\nposition = [\"{} mm\", \"0 mm\"]\n", of,
                        x += 2);
  Experiment e(own_scene(text + R"(
[[bond]]
between = ["stone", "stone"]
origin = "initial"
inside = true
strength = "10 MPa"
fracture_energy = "20 J/m^2"
[[stage]]
name = "rest"
kind = "hold"
duration = "1 us"
)"));
  e.run(1);
  EXPECT_THAT(e.field("parent"), ::testing::ElementsAre(0, 1, 1, 1, 4, 5, 5, 5, 8));
  EXPECT_THAT(e.field("fragment"), ::testing::ElementsAre(0, 1, 1, 1, 4, 5, 5, 5, 8));
}

// A weld joins two particles, and is no damage when it breaks.
TEST(BondResults, WeldsJoinFragmentsAndAreNoDamage) {
  Experiment e("bonds/cold-weld.toml");
  std::vector<double> fragments;
  e.run(50, [&] {
    const double now = e.value("bonds/fragments");
    if (fragments.empty() || fragments.back() != now) fragments.push_back(now);
  });
  EXPECT_THAT(fragments, ::testing::ElementsAre(2, 1, 2));
  EXPECT_TRUE(std::isnan(e.value("bonds/damage")));
  EXPECT_EQ(bond_findings(e.simulation.world())->damage, std::nullopt);
}

TEST(BondResults, AreAbsentWithoutBonds) {
  Experiment e("basic/oblique-impact.toml");
  e.run(1);
  EXPECT_TRUE(e.results.tables().empty());
  EXPECT_FALSE(bond_findings(e.simulation.world()));
  for (const SeriesInfo& series : e.results.series())
    EXPECT_THAT(series.name, ::testing::Not(::testing::HasSubstr("bonds/")));
  for (const FieldInfo& field : e.results.fields())
    EXPECT_THAT(field.name,
                ::testing::Not(::testing::ContainsRegex("bonds/|cracks/|fragment|damage")));
}

TEST(Glue, IsBitwiseTheSameForAnyThreads) {
  const auto hash = [](int threads) {
    Experiment e("bonds/cold-weld.toml", {}, threads);
    e.run(5);
    return state_hash(e.simulation.world());
  };
  const auto one = hash(1);
  EXPECT_EQ(hash(2), one);
  EXPECT_EQ(hash(3), one);
}

// ---- walls ---------------------------------------------------------------------------------------------------
// Blocks of 1 mm in two courses; `shift` of the upper one in mm.
std::string wall(double shift, const std::string& bonds) {
  std::string text = bar_material;
  for (const int columns : {5, 8})
    text += fmt::format(
        "[[particle]]\nname = \"of-{0}\"\nmaterial = \"stone\"\noutline = \"rectangle\"\nwidth = "
        "\"1 "
        "mm\"\nheight = \"1 mm\"\n[particle.mesh]\ncolumns = {0}\nrows = 2\n",
        columns);
  for (const auto& [columns, x, y] : {std::tuple{5, 0.5, 0.5},
                                      {8, 1.5, 0.5},
                                      {5, 2.5, 0.5},
                                      {8, 0.5 + shift, 1.5},
                                      {8, 1.5 + shift, 1.5}})
    text += fmt::format("[[body]]\nparticle = \"of-{}\"\nposition = [\"{} mm\", \"{} mm\"]\n",
                        columns, x, y);
  return text + bonds + "[[stage]]\nname = \"rest\"\nkind = \"hold\"\nduration = \"4 us\"\n";
}
constexpr const char* mortar =
    "[[bond]]\nbetween = [\"stone\", \"stone\"]\norigin = \"initial\"\nstrength = \"10 "
    "MPa\"\nfracture_energy = \"20 J/m^2\"\n";

// A block's corner in the middle of an edge below: every point looks for its own closest one.
TEST(Wall, LaidInABondTouchesWithoutForceAndIsGluedEverywhere) {
  Experiment e(own_scene(wall(0.5, mortar)));
  e.run(4);
  EXPECT_NEAR(e.value("bonds/area"), (2 + 1 + 2) * 1e-6, 1e-12);
  EXPECT_LT(std::abs(e.value("penetration")), 1e-6);
  EXPECT_LT(e.results.energies().kinetic, 1e-18);
}

// Their corners attract each other, and stay where they are.
TEST(Wall, ThatClingsRestsAsLongAsNothingMoves) {
  Experiment e(own_scene(wall(0, std::string(mortar) +
                                     "[[bond]]\nbetween = [\"stone\", \"stone\"]\norigin = "
                                     "\"adhesion\"\nwork = \"1 J/m^2\"\nrange = \"0.04 mm\"\n")));
  std::vector<double> stored;
  e.run(40, [&] { stored.push_back(e.results.energies().contact); });
  EXPECT_LT(stored.front(), -1e-9);
  for (const double now : stored) EXPECT_NEAR(now, stored.front(), 1e-3 * -stored.front());
}

TEST(Glue, TooBrittleForItsMeshIsRefusedWithTheLeastEnergy) {
  EXPECT_THAT(message_of([] {
                Experiment e("bonds/pulled-blocks.toml", {"bond[0].fracture_energy=1 mJ/m^2"});
              }),
              ::testing::HasSubstr("allowed: >= "));
}

}  // namespace
}  // namespace pulvis
