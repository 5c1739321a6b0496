// Local densities in three dimensions: volumes are those of the particles, whatever the grid; the room is that between the
// tools' true surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include "components/space/observed.hpp"
#include "scenes/results/state_hash.hpp"
#include "scenes/spec/scene.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis::space {
namespace {

using std::numbers::pi;

Scene scene_with_cells(const char* file, const std::string& cells,
                       std::vector<std::string> more = {}) {
  more.push_back("output.density_cells=" + cells);
  return read_scene(paths::source_dir() + "/scenes/compaction-3d/" + file, more);
}

const DensityGrid& observed_grid(Experiment& e) {
  e.simulation.observe();
  e.results.sample();
  return e.simulation.world().resource<DensityGrid>();
}
double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Volume of all elements now: of hexahedra whose nodes a frame has, by the vectors between their middles at the Gauss points,
// exact for trilinear ones.
double volume_of_elements(Experiment& e) {
  const World& world = e.simulation.world();
  const std::vector<double> x = e.field("position");
  const Shapes& shapes = world.resource<Shapes>();
  double volume = 0;
  std::size_t first = 0;
  for (const int slot : world.resource<Bodies>().slot_of_number) {
    const Shape& shape = entry(shapes.list, entry(world.resource<Bodies>().slots, slot).shape);
    for (const auto& nodes : shape.hexahedra)
      for (int g = 0; g < 8; ++g) {
        Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
        for (int n = 0; n < 8; ++n) {
          const std::array<double, 3> natural{Shape::mode_sign(0, n), Shape::mode_sign(1, n),
                                              Shape::mode_sign(2, n)};
          for (int axis = 0; axis < 3; ++axis) {
            double weight = 0.125 * natural[static_cast<std::size_t>(axis)];
            for (int other = 0; other < 3; ++other)
              if (other != axis)
                weight *= 1 + natural[static_cast<std::size_t>(other)] *
                                  Shape::mode_sign(other, g) / std::sqrt(3.0);
            slope.col(axis) +=
                weight * Vec3::Map(&x[first + 3 * static_cast<std::size_t>(
                                                      nodes[static_cast<std::size_t>(n)].value)]);
          }
        }
        volume += slope.determinant();
      }
    first += 3 * shape.nodes.size();
  }
  return volume;
}

// A lattice of balls that touch each other and the planes: pi/6 in each cell with a ball, less what the corners of a face
// that stand out of the ball leave in a neighbour or in a plane: below a thousandth.
TEST(DensityInSpace, OfASimpleLatticeIsThatOfABallInItsCube) {
  Experiment e(scene_with_cells("unit-cell-sc.toml", "[1, 1, 1]"));
  EXPECT_NEAR(observed_grid(e).filled[0] / observed_grid(e).room[0], pi / 6, 1e-3);
  EXPECT_NEAR(e.value("density/compact"), pi / 6, 1e-3);
}

// Body-centred: alike in all octants, by the symmetry of the lattice and of the meshes.
TEST(DensityInSpace, OfABodyCentredCellIsAlikeInAllOctants) {
  Experiment e(scene_with_cells("unit-cell-bcc.toml", "[2, 2, 2]",
                                {"let.move=0.3 mm", "stage.press.duration=0.02 ms"}));
  e.run(1);
  const DensityGrid& grid = observed_grid(e);
  for (std::size_t c = 0; c < 8; ++c)
    EXPECT_NEAR(grid.filled[c], grid.filled[0], 1e-6 * grid.filled[0]) << c;
  EXPECT_LT(e.value("density/deviation"), 1e-6);
}

// With planes drawn back, so that no particle reaches into one.
TEST(DensityInSpace, HoldsTheVolumeOfTheDeformedElementsWhateverTheGrid) {
  for (const char* cells : {"[1, 1, 1]", "[3, 4, 5]", "[17, 16, 15]"}) {
    Scene scene = scene_with_cells("unit-cell-bcc.toml", cells,
                                   {"let.move=0.6 mm", "stage.press.duration=0.04 ms"});
    Experiment e(std::move(scene));
    e.run(1);
    World& world = e.simulation.world();
    for (const int side : world.resource<DensityGrid>().between.tool)
      for (int k = 0; k < 3; ++k) {
        const Vec3 normal = e.scene.tools[static_cast<std::size_t>(side)].normal;
        world.resource<ToolProgram>()
            .start[static_cast<std::size_t>(side)][static_cast<std::size_t>(k)] -= 1e-3 * normal[k];
      }
    const double volume = volume_of_elements(e);
    EXPECT_NEAR(total(observed_grid(e).filled), volume, 1e-10 * volume) << cells;
  }
}

Scene loose_tablet(const std::string& cells, const std::string& die_height = "44 mm") {
  return scene_with_cells(
      "tablet.toml", cells,
      {"packing[0].density=0.4", "packing[0].class[0].number=20", "tool[0].height=" + die_height});
}

// A loose tablet with the top punch drawn back, in a die that is lowered.
std::unique_ptr<Experiment> in_lowered_die(double top, double lowered) {
  Scene scene = loose_tablet("[2, 3, 4]");
  ToolSpec& punch = scene.tools.back();
  punch.on_packing = false;
  punch.point = Vec3(0, 0, top);
  scene.tools.front().point.z() -= lowered;
  auto e = std::make_unique<Experiment>(std::move(scene));
  observed_grid(*e);
  return e;
}

// Beyond the mouth of the die nothing encloses the powder.
TEST(DensityInSpace, IsThatInsideTheDie) {
  constexpr double radius = 18e-3, mouth = 44e-3;
  const double area = pi * radius * radius;
  const auto grid_of = [](Experiment& e) -> const DensityGrid& {
    return e.simulation.world().resource<DensityGrid>();
  };
  const auto closed = in_lowered_die(0.9 * mouth, 0), open = in_lowered_die(1.1 * mouth, 0);
  const double volume = total(grid_of(*closed).filled);
  EXPECT_NEAR(closed->value("density/compact"), volume / (area * 0.9 * mouth), 1e-9);
  EXPECT_NEAR(closed->value("relative_density"), volume / (area * 0.9 * mouth), 1e-3);
  EXPECT_DOUBLE_EQ(grid_of(*open).high[2], mouth);
  EXPECT_NEAR(open->value("density/compact"), volume / (area * mouth), 1e-9);
  EXPECT_TRUE(std::isnan(open->value("relative_density")));

  const auto ejected = in_lowered_die(1.1 * mouth, 1.1 * mouth);
  for (const char* name : {"relative_density", "density/compact", "density/maximum"})
    EXPECT_TRUE(std::isnan(ejected->value(name))) << name;
  for (const double cell : ejected->field("local_density")) EXPECT_TRUE(std::isnan(cell));
}

// The rooms of the cells are those of the cylinder. Before the first step nothing is deformed; corners of faces that stand out
// of their balls reach into tools and neighbours.
TEST(DensityInSpace, FillsARoundDieBetweenPlanes) {
  Experiment e(loose_tablet("[6, 5, 4]"));
  const DensityGrid& grid = observed_grid(e);
  const double radius = grid.between.diameter / 2, height = grid.high[2] - grid.low[2];
  EXPECT_NEAR(total(grid.room), pi * radius * radius * height, 1e-12 * total(grid.room));
  EXPECT_NEAR(e.value("density/compact"), e.value("relative_density"), 1e-3);
}

// A cone on the face of a punch, or a hollow in it.
TEST(DensityInSpace, TakesTheProfileOfAPunchFromTheRoom) {
  for (const double rise : {2e-3, -2e-3}) {
    Scene scene = loose_tablet("[7, 7, 9]", "70 mm");
    ToolSpec& top = scene.tools.back();
    top.shape = ToolSpec::Shape::punch;
    top.diameter = 36e-3;
    top.profile = {Vec2(0, rise), Vec2(18e-3, 0)};
    top.on_packing = false;
    top.point = Vec3(0, 0, 60e-3);
    Experiment e(std::move(scene));
    const double disc = pi * 18e-3 * 18e-3, room = disc * (60e-3 - rise / 3);
    EXPECT_NEAR(total(observed_grid(e).room), room, 1e-5 * room) << rise;
  }
}

TEST(DensityInSpace, HasTheSameBitsForAnyNumberOfThreadsAndLeavesTheRunAlone) {
  const auto state = [](const std::string& cells, int threads) {
    std::vector<std::string> more{"let.move=0.3 mm", "stage.press.duration=0.02 ms"};
    if (!cells.empty()) more.push_back("output.density_cells=" + cells);
    auto e = std::make_unique<Experiment>(
        read_scene(paths::source_dir() + "/scenes/compaction-3d/unit-cell-bcc.toml", more),
        threads);
    e->run(3);
    return e;
  };
  const auto one = state("[4, 5, 6]", 1), two = state("[4, 5, 6]", 2), without = state("", 1);
  ASSERT_EQ(one->row.size(), two->row.size());  // some of their numbers are not a number
  EXPECT_EQ(std::memcmp(one->row.data(), two->row.data(), sizeof(double) * one->row.size()), 0);
  EXPECT_EQ(one->field("local_density"), two->field("local_density"));
  EXPECT_EQ(state_hash(one->simulation.world()), state_hash(without->simulation.world()));
}

TEST(DensityInSpace, NeedsARoom) {
  const auto problems = problems_in([] { scene_with_cells("one-sphere.toml", "[2, 2, 2]"); });
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems.front().key, "output.density_cells");
}

}  // namespace
}  // namespace pulvis::space
