// Grains with sharp edges on coarse meshes: their contacts are found from the first step on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes/read.hpp"
#include "scenes/space/packing/place.hpp"
#include "scenes/space/space_warnings.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

constexpr const char* box = R"(
[[tool]]
name = "bottom"
shape = "plane"
point = ["0 mm", "0 mm", "0 mm"]
normal = [0, 0, 1]
[[tool]]
name = "top"
shape = "plane"
point = ["0 mm", "0 mm", "packing top"]
normal = [0, 0, -1]
[[tool]]
name = "left"
shape = "plane"
point = ["0 mm", "0 mm", "0 mm"]
normal = [1, 0, 0]
[[tool]]
name = "right"
shape = "plane"
point = ["1 mm", "0 mm", "0 mm"]
normal = [-1, 0, 0]
[[tool]]
name = "front"
shape = "plane"
point = ["0 mm", "0 mm", "0 mm"]
normal = [0, 1, 0]
[[tool]]
name = "back"
shape = "plane"
point = ["0 mm", "1 mm", "0 mm"]
normal = [0, -1, 0]
[[stage]]
name = "press"
kind = "compact"
duration = "20 us"
move = [{ tool = "top", displacement = ["0 mm", "0 mm", "-0.3 mm"] }]
)";

constexpr const char* cube = R"(shape = "polyhedron"
corners = [["0 mm", "0 mm", "0 mm"], ["0.3 mm", "0 mm", "0 mm"], ["0 mm", "0.3 mm", "0 mm"],
  ["0 mm", "0 mm", "0.3 mm"], ["0.3 mm", "0.3 mm", "0 mm"], ["0.3 mm", "0 mm", "0.3 mm"],
  ["0 mm", "0.3 mm", "0.3 mm"], ["0.3 mm", "0.3 mm", "0.3 mm"]]
rounding = "0.04 mm"
)";
constexpr const char* octahedron = R"(shape = "polyhedron"
corners = [["0.2 mm", "0 mm", "0 mm"], ["-0.2 mm", "0 mm", "0 mm"], ["0 mm", "0.2 mm", "0 mm"],
  ["0 mm", "-0.2 mm", "0 mm"], ["0 mm", "0 mm", "0.2 mm"], ["0 mm", "0 mm", "-0.2 mm"]]
rounding = "0.02 mm"
)";

Scene sharp_grains(const char* shape, int divisions, const char* density) {
  const std::string text = fmt::format(
      R"(family = "compaction"
dimension = 3
title = "sharp grains"
material = [{{ name = "brass", density = "8500 kg/m^3", youngs_modulus = "105 GPa", poissons_ratio = 0.34, yield_stress = "150 MPa", hardening_modulus = "300 MPa" }}]
contact = {{ friction = 1.0, damping = 0.1 }}
[[particle]]
name = "grain"
material = "brass"
{}mesh = {{ divisions = {}, rings = 1 }}
[[packing]]
kind = "random"
width = "1 mm"
depth = "1 mm"
density = {}
class = [{{ particle = "grain", number = 12 }}]
{})",
      shape, divisions, density, box);
  return load_scene_text(text, "sharp.toml").scene;
}

struct SharpGrains {
  const char *name, *shape;
  int divisions;
  const char* density;
};
void PrintTo(const SharpGrains& grains, std::ostream* stream) { *stream << grains.name; }

class SharpGrainsInABox : public testing::TestWithParam<SharpGrains> {};

// Edges meet faces in the packing already. A closest point on the far side of a neighbour, or on a side that is none, would be a
// penetration out of nothing, or energy that is lost when it is found.
TEST_P(SharpGrainsInABox, LoseNoEnergy) {
  const auto [name, shape, divisions, density] = GetParam();
  Experiment e(sharp_grains(shape, divisions, density));
  e.run(20);
  EXPECT_LT(e.results.energy_balance_error(), 0.02);
  EXPECT_LT(e.simulation.world().resource<Totals>().unconverged_share(), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(All, SharpGrainsInABox,
                         testing::Values(SharpGrains{"Cubes", cube, 4, "0.4"},
                                         SharpGrains{"Octahedra", octahedron, 4, "0.3"}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(SharpGrainsWarnings, TellThatBendsAreRoundedOff) {
  const Scene coarse = sharp_grains(octahedron, 3, "0.1");
  const std::vector<std::string> lines = space::setup_warnings(coarse, space::place_bodies(coarse));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("'grain'"), std::string::npos);
  EXPECT_NE(lines[0].find("sharp bends are rounded off"), std::string::npos);
  const Scene fine = sharp_grains(cube, 8, "0.1");
  EXPECT_TRUE(space::setup_warnings(fine, space::place_bodies(fine)).empty());
}

}  // namespace
}  // namespace pulvis
