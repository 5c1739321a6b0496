// Grains with sharp edges on coarse meshes: their contacts are found from the first step on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes/packing/place.hpp"
#include "scenes/setup_warnings.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

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

// Twelve in the die of the shipped powder, a fiftieth of its size.
Scene sharp_grains(const char* shape, int divisions, const char* density) {
  return own_scene(fmt::format(R"(extends = "compaction-3d/random-100-316L.toml"
remove = ["particle.ball", "stage.press.until"]
[let]
W = "1 mm"
[[particle]]
name = "grain"
material = "316L"
{}mesh = {{ divisions = {}, rings = 1 }}
[[packing]]
kind = "random"
width = "W"
depth = "W"
density = {}
class = [{{ particle = "grain", number = 12 }}]
[[stage]]
name = "press"
duration = "20 us"
[[stage.move]]
tool = "top"
displacement = ["0 mm", "0 mm", "-0.3 mm"]
[contact]
friction = 1.0
)",
                               shape, divisions, density));
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
  const std::vector<std::string> lines = setup_warnings(coarse, place_bodies(coarse));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("'grain'"), std::string::npos);
  EXPECT_NE(lines[0].find("sharp edges are rounded off"), std::string::npos);
  const Scene fine = sharp_grains(cube, 8, "0.1");
  EXPECT_TRUE(setup_warnings(fine, place_bodies(fine)).empty());
}

}  // namespace
}  // namespace pulvis
