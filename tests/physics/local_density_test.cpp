// Local densities: areas are those of the particles, whatever the grid; the room is that between the
// tools' true surfaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "components/observed.hpp"
#include "scenes/tools/die_sides.hpp"
#include "systems/body/systems.hpp"
#include "systems/observe/systems.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

using std::numbers::pi;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

const std::string square = "compaction/regular-25.toml";

const DensityGrid& grid_of(Experiment& e) { return e.simulation.world().resource<DensityGrid>(); }
double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// The scene with its planes drawn back by half a millimetre.
Scene with_room(const std::string& file, const std::vector<std::string>& overrides) {
  Scene scene = read_scene(paths::source_dir() + "/scenes/" + file, overrides);
  for (ToolSpec& tool : scene.tools) tool.point -= 0.5e-3 * tool.normal;
  return scene;
}

// The corners of an outline's polygon stand out of its disc, that their area be the same: by how much of
// a disc's area one reaches beyond a tangent.
double share_of_a_tip(int corners) {
  const double turn = 2 * pi / corners, out = std::sqrt(turn / std::sin(turn));
  const double share = (out - 1) / (out * (1 - std::cos(turn)));  // of the edges beside it
  return (out - 1) * share * out * std::sin(turn) / pi;
}

// A particle in each cell: pi/4. What reaches into one neighbour comes back from the other, but at tools.
TEST(LocalDensity, OfASquareMatrixIsThatOfADiscInItsSquare) {
  Experiment e(square, {"output.density_cells=[5, 5]"});
  e.simulation.observe();
  const DensityGrid& grid = grid_of(e);
  ASSERT_EQ(grid.filled.size(), 25U);
  for (int c = 0; c < 25; ++c) {
    const int i = c % 5, j = c / 5, at_tools = (i % 4 == 0 ? 1 : 0) + (j % 4 == 0 ? 1 : 0);
    const auto cell = static_cast<std::size_t>(c);
    EXPECT_NEAR(grid.filled[cell] / grid.room[cell], pi / 4 * (1 - at_tools * share_of_a_tip(40)),
                1e-12)
        << c;
  }
  e.results.sample();
  EXPECT_NEAR(e.value("density/compact"),
              e.value("relative_density") * (1 - 20 * share_of_a_tip(40) / 25), 1e-12);
  EXPECT_LT(e.value("density/deviation"), 2 * share_of_a_tip(40));
}

// Tools that nothing reaches into, and grids that have nothing to do with the matrix.
TEST(LocalDensity, AddsUpToTheAreaOfTheParticlesOnAnyGrid) {
  for (const char* cells : {"[4, 4]", "[1, 1]", "[7, 3]", "[13, 40]"}) {
    Experiment e(with_room(square, {std::string("output.density_cells=") + cells}));
    e.simulation.observe();
    EXPECT_NEAR(sum(grid_of(e).filled) / (25 * pi / 4 * 1e-4), 1, 1e-12) << cells;
    EXPECT_NEAR(sum(grid_of(e).room) / (51e-3 * 51e-3), 1, 1e-12) << cells;
  }
}

// In a compact the particles reach into the tools by the penetration of the contacts: that is all that
// is missing of their deformed area.
TEST(LocalDensity, OfACompactMissesOnlyWhatReachesIntoTheTools) {
  const std::vector<std::string> short_run{"stage.press.duration=0.7 ms",
                                           "output.particle_stress=true", "contact.hardness=1000"};
  auto with = [&](const std::string& cells) {
    auto all = short_run;
    all.push_back("output.density_cells=" + cells);
    return all;
  };
  Experiment e(square, with("[1, 1]")), fine(square, with("[9, 14]"));
  for (Experiment* one : {&e, &fine}) one->run(2);
  const double missing = 1 - sum(grid_of(e).filled) / [&] {
    double area = 0;
    for (const int slot : e.simulation.world().resource<Bodies>().slot_of_number)
      area += e.column<DeformedSize<TwoD>>().values()[slot];
    return area;
  }();
  EXPECT_GT(missing, 0);
  EXPECT_LT(missing, 4 * e.value("penetration") * (10e-3 * pi / 40) / 45e-3);
  const auto fields = fine.results.fields();
  const auto rows = std::ranges::find(fields, "density_grid/y", &FieldInfo::name) - fields.begin();
  EXPECT_NEAR(sum(fine.results.frame().at(static_cast<std::size_t>(rows))), 15 * 45e-3 / 2, 1e-9);
  EXPECT_NEAR(sum(grid_of(fine).filled) / sum(grid_of(e).filled), 1, 1e-12);
  EXPECT_GT(fine.value("density/deviation"), 0);
}

TEST(LocalDensity, KnowsTheHoleOfARing) {
  Scene scene = with_room("compaction/unit-cell.toml", {"output.density_cells=[3, 4]"});
  scene.particles[0].outline = RingOutline{10e-3, 6e-3};
  scene.particles[0].mesh = RingMesh{40, 3};
  Experiment e(std::move(scene));
  e.simulation.observe();
  EXPECT_NEAR(sum(grid_of(e).filled) / (pi * (25e-6 - 9e-6)), 1, 1e-12);
}

// A punch with a tooth, of which the grid sees the outline: the box reaches to its base, and the cells lose
// the tooth. A rough wall likewise.
TEST(LocalDensity, HasTheTrueSurfaceOfAPolyline) {
  Scene scene = with_room("compaction/unit-cell.toml", {"output.density_cells=[2, 3]"});
  const DieSides sides = *die_sides(scene);
  ToolSpec& top = scene.tools[static_cast<std::size_t>(sides[DensityGrid::top])];
  top.shape = ToolSpec::Shape::polyline;
  top.points = {{12e-3, 13e-3}, {10e-3, 13e-3}, {9e-3, 10.5e-3}, {8e-3, 13e-3}, {-2e-3, 13e-3}};
  ToolSpec& left = scene.tools[static_cast<std::size_t>(sides[DensityGrid::left])];
  left.shape = ToolSpec::Shape::polyline;
  left.points = {{-1e-3, 15e-3}, {-1e-3, 2e-3}, {-1e-3 / 2, 1e-3}, {-1e-3, 0}, {-1e-3, -5e-3}};
  EXPECT_EQ(*die_sides(scene), sides);
  Experiment e(std::move(scene));
  e.simulation.observe();
  const DensityGrid& grid = grid_of(e);
  EXPECT_NEAR(grid.side[DensityGrid::left], -1e-3, 1e-15);
  EXPECT_NEAR(grid.side[DensityGrid::top], 13e-3, 1e-15);
  const double tooth = 2e-3 * 2.5e-3 / 2, spur = 2e-3 * 0.5e-3 / 2;
  EXPECT_NEAR(sum(grid.room) / (11.5e-3 * 13.5e-3 - tooth - spur), 1, 1e-12);
  const double cell = 11.5e-3 / 2 * 13.5e-3 / 3;
  EXPECT_NEAR(grid.room[5] / (cell - tooth), 1, 1e-12);
  EXPECT_NEAR(grid.room[0] / (cell - spur), 1, 1e-12);
  EXPECT_NEAR(grid.room[2] / cell, 1, 1e-12);
  EXPECT_NEAR(sum(grid.filled) / (pi * 25e-6), 1, 1e-12);
}

// ---- a die that ends -----------------------------------------------------------------------------------
// The grid with the punches of `e` at these heights.
const DensityGrid& grid_between(Experiment& e, double bottom, double top) {
  World& w = e.simulation.world();
  double* at = w.column<ToolPosition>().values();
  const auto& tool = w.resource<DensityGrid>().tool;
  at[tool_axes * tool[DensityGrid::bottom] + 1] = bottom;
  at[tool_axes * tool[DensityGrid::top] + 1] = top;
  open<local_density>(w)();
  return w.resource<DensityGrid>();
}

// 50 mm wide and 51 mm deep, its lip rounded by 1 mm. It ends where the lip looks up more than inwards.
TEST(LocalDensity, StaysInADieWithAMouth) {
  Experiment e("compaction/ejection-25.toml", {"output.density_cells=[5, 5]"});
  const double mouth = 50e-3 + 1e-3 * std::sqrt(0.5), lip = 1e-3 * (1 - std::sqrt(0.5));
  const DensityGrid& grid = grid_between(e, 0, 49e-3);
  EXPECT_THAT(grid.side, ElementsAre(0, 50e-3, 0, 49e-3));
  grid_between(e, 0, 195e-3);
  EXPECT_THAT(grid.side, Pointwise(DoubleNear(1e-12), {-lip, 50e-3 + lip, 0.0, mouth}));
  EXPECT_NEAR(sum(grid.filled) / (25 * pi / 4 * 1e-4), 1, 0.01);
  // Beside the lips: under the mouth, over an eighth of a circle less its triangle.
  const double lips = 2 * (std::sqrt(0.5) * lip * 1e-3 - (pi / 8 - 0.25) * 1e-6);
  EXPECT_NEAR(sum(grid.room), mouth * 50e-3 + lips, 0.01e-6);
  grid_between(e, 40e-3, 195e-3);
  EXPECT_THAT(grid.side, Pointwise(DoubleNear(1e-12), {-lip, 50e-3 + lip, 40e-3, mouth}));
  EXPECT_LT(sum(grid.filled) / sum(grid.room), 1);
}

TEST(LocalDensity, IsNoneWhereThePunchesStandBeyondTheDie) {
  Experiment e("compaction/ejection-25.toml", {"output.density_cells=[5, 5]"});
  e.simulation.observe();
  const DensityGrid& grid = grid_between(e, 53e-3, 195e-3);
  for (const double side : grid.side) {
    EXPECT_GE(side, -1e-3);
    EXPECT_LE(side, 51e-3);
  }
  EXPECT_EQ(sum(grid.room), 0);
  e.results.sample();
  for (const char* series : {"compact", "minimum", "maximum", "deviation"})
    EXPECT_TRUE(std::isnan(e.value(std::string("density/") + series))) << series;
  const auto frame = e.results.frame();
  for (const double value : frame.at(frame.size() - 4)) EXPECT_TRUE(std::isnan(value));
}

TEST(LocalDensity, OfToolsThatMoveApartIsThatOfAllBetweenThem) {
  Experiment e(square, {"output.density_cells=[5, 5]"});
  const DensityGrid& grid = grid_between(e, -50e-3, 200e-3);
  EXPECT_THAT(grid.side, ElementsAre(0, 50e-3, -50e-3, 200e-3));
  EXPECT_NEAR(sum(grid.filled) / (25 * pi / 4 * 1e-4), 1, 0.02);
  EXPECT_EQ(grid.filled.back(), 0);
}

// From the first sample to the last, in which the compact lies outside.
TEST(LocalDensity, IsOneAtMostAllTheWayOutOfADie) {
  Experiment e("compaction/ejection-25.toml",
               {"output.density_cells=[5, 5]", "particle.disc.mesh.boundary_edges=12"});
  int empty = 0;
  e.run(60, [&] {
    const auto& side = grid_of(e).side;
    EXPECT_GE(side[0], -1e-3);
    EXPECT_LE(side[1], 51e-3);
    EXPECT_GE(side[2], 0);
    EXPECT_LE(side[3], 51e-3);
    const double greatest = e.value("density/maximum");
    if (std::isnan(greatest))
      ++empty;
    else
      EXPECT_LT(greatest, 1.01) << e.simulation.clock().time;
  });
  EXPECT_GT(empty, 2);
  EXPECT_LT(empty, 40);
}

TEST(DieSides, NeedOneToolOnEachSide) {
  Scene scene = read_scene(paths::source_dir() + "/scenes/compaction/unit-cell.toml");
  ASSERT_TRUE(die_sides(scene));
  Scene twice = scene;
  twice.tools.push_back(twice.tools.front());
  EXPECT_FALSE(die_sides(twice));
  twice.tools.back().shape = ToolSpec::Shape::constraint;
  EXPECT_EQ(die_sides(twice), die_sides(scene));
  Scene turned = scene;
  turned.tools[0].normal = Vec3(1, 0.1, 0).normalized();
  EXPECT_FALSE(die_sides(turned));
  Scene open = scene;
  open.tools.pop_back();
  EXPECT_FALSE(die_sides(open));
}

}  // namespace
}  // namespace pulvis
