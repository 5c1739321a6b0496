// The report of particles in three dimensions: what is drawn of hexahedra, the density along z, the page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <sstream>

#include "cli/report/report.hpp"
#include "cli/report/report_profile.hpp"
#include "cli/report/report_space_mesh.hpp"
#include "tests/helpers/synthetic_space_run.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;

// n x n x n cells of a cube whose edge is 1, all of one particle.
SpaceMesh block(int n) {
  SpaceMesh mesh;
  const int side = n + 1;
  for (int i = 0; i < side * side * side; ++i)
    for (const int k : {i % side, i / side % side, i / side / side})
      mesh.reference.push_back(static_cast<double>(k) / n);
  for (int i = 0; i < n * n * n; ++i) {
    const int first = i % n + side * (i / n % n) + side * side * (i / n / n);
    for (const int above : {0, side * side})
      for (const int to : {0, 1, side + 1, side}) mesh.hexahedra.push_back(first + above + to);
  }
  mesh.cell_particle.assign(static_cast<std::size_t>(n * n * n), 0);
  mesh.node_particle.assign(static_cast<std::size_t>(side * side * side), 0);
  return mesh;
}

TEST(SpaceMesh, OuterSidesAreThoseOfTheBlock) {
  EXPECT_EQ(outer_sides(block(3).hexahedra).size(), 6U * 9U);
}

TEST(SpaceMesh, PyramidsKeepTheSurfaceAndTheMeans) {
  const SpaceMesh mesh = block(4);
  const DrawnSpace drawn = DrawnSpace::pyramids(mesh);
  EXPECT_EQ(drawn.cell_count(), 6U * 16U);
  EXPECT_EQ(drawn.node_count(), 1U + 98U);  // the centre, and the 5^3 - 3^3 outside
  double volume = 0;  // by the triangles of the surface, as seen from the origin
  const auto xyz = drawn.positions(mesh.reference);
  for (const auto side : drawn.surface()) {
    std::array<Eigen::Vector3d, 4> at;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto corner = sides_of_hexahedron[static_cast<std::size_t>(side % 6)][k];
      const auto node = drawn.cells()[8 * static_cast<std::size_t>(side / 6) + corner];
      at[k] = Eigen::Vector3d::Map(&xyz[3 * static_cast<std::size_t>(node)]);
    }
    volume += at[0].dot(at[1].cross(at[2]) + at[2].cross(at[3])) / 6;
  }
  EXPECT_NEAR(volume, 1, 1e-12);  // and the faces look outward
  EXPECT_THAT(drawn.values(std::vector<double>(64, 7.0)),
              Each(AllOf(::testing::Ge(7 - 1e-12), ::testing::Le(7 + 1e-12))));
}

TEST(DensityAlongZ, IsOneInAFullRoomAndHalfInOneOfTwiceTheArea) {
  const SpaceMesh mesh = block(3);
  for (const double area : {1.0, 2.0})
    for (const double density :
         density_along_z(mesh.reference, mesh.hexahedra, {.area = area, .bound = {}}, 7).density)
      EXPECT_NEAR(density, 1 / area, 1e-12);
}

TEST(DensityAlongZ, HoldsTheWholeVolume) {
  SpaceMesh mesh = block(3);
  for (std::size_t i = 0; i < mesh.reference.size(); i += 3)  // sheared: the volume stays
    mesh.reference[i + 2] += 0.3 * mesh.reference[i] - 0.2 * mesh.reference[i + 1];
  const auto [density, edges] =
      density_along_z(mesh.reference, mesh.hexahedra, {.area = 2, .bound = {}}, 11);
  const double sum = std::accumulate(density.begin(), density.end(), 0.0);
  EXPECT_NEAR(2.0 * sum * (edges[1] - edges[0]), 1, 1e-12);
  EXPECT_LT(density.front(), 0.5 * density[5]);  // only a corner reaches down there
}

// A cube of one element on its corner: its section is a triangle, a hexagon, a triangle.
TEST(DensityAlongZ, HasTheExactVolumeOfEachSlice) {
  SpaceMesh mesh = block(1);
  for (std::size_t i = 0; i < mesh.reference.size(); i += 3) {
    const double x = mesh.reference[i], y = mesh.reference[i + 1], z = mesh.reference[i + 2];
    mesh.reference[i] = (x - y) / std::sqrt(2.0);
    mesh.reference[i + 1] = (x + y - 2 * z) / std::sqrt(6.0);
    mesh.reference[i + 2] = (x + y + z) / std::sqrt(3.0);
  }
  const auto [density, edges] =
      density_along_z(mesh.reference, mesh.hexahedra, {.area = 2, .bound = {}}, 9);
  const auto below = [](double z) {
    const auto cube = [](double s) { return s > 0 ? s * s * s / 6 : 0; };
    const double s = std::sqrt(3.0) * z;
    return cube(s) - 3 * cube(s - 1) + 3 * cube(s - 2) - cube(s - 3);
  };
  ASSERT_EQ(density.size(), 9U);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(2 * density[i] * (edges[i + 1] - edges[i]), below(edges[i + 1]) - below(edges[i]),
                1e-14);
}

// What has penetrated the lower one does not count; above the powder there is nothing.
TEST(DensityAlongZ, IsThatBetweenThePunches) {
  const SpaceMesh mesh = block(3);
  const auto [density, edges] = density_along_z(
      mesh.reference, mesh.hexahedra, {.area = 1, .bound = {}, .bottom = 0.2, .top = 1.4}, 3);
  ASSERT_EQ(density.size(), 3U);
  EXPECT_NEAR(density[0], 1, 1e-12);
  EXPECT_NEAR(density[1], 1, 1e-12);
  EXPECT_NEAR(density[2], 0, 1e-12);
}

TEST(DensityAlongZ, EndsWhereTheSpaceEnds) {
  const SpaceMesh mesh = block(3);
  const CrossSection to_mouth{.area = 2, .bound = {}, .high = 0.7};
  const auto [density, edges] = density_along_z(mesh.reference, mesh.hexahedra, to_mouth, 7);
  EXPECT_THAT(density, Each(::testing::DoubleNear(0.5, 1e-12)));  // nothing of what is above
  EXPECT_DOUBLE_EQ(edges.back(), 0.7);
  const CrossSection below{.area = 2, .bound = {}, .high = -0.1};
  EXPECT_TRUE(density_along_z(mesh.reference, mesh.hexahedra, below, 7).density.empty());
}

// A die of eight sides and radius 2, and the conical face of a punch: its tip is at 1.5, its rim at 2 along the axis.
hdf5::File die_and_punch(const fs::path& path, int axis) {
  constexpr int sides = 8;
  std::vector<double> xyz;
  std::vector<std::int32_t> quads, tool;
  for (const auto& [radius, height] : {std::pair{2.0, -1.0}, {2.0, 3.0}, {0.0, 1.5}, {2.0, 2.0}})
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      const std::array<double, 3> at{radius * std::cos(angle), radius * std::sin(angle), height};
      for (int k = 0; k < 3; ++k) xyz.push_back(at[static_cast<std::size_t>((k - axis + 5) % 3)]);
    }
  for (const int which : {0, 1})
    for (int i = 0; i < sides; ++i) {
      const int low = 2 * which * sides + i, next = 2 * which * sides + (i + 1) % sides;
      if (which == 0)
        quads.insert(quads.end(), {low, low + sides, next + sides, next});
      else
        quads.insert(quads.end(), {low, next + sides, low + sides, low});
      tool.push_back(which);
    }
  fs::create_directories(path.parent_path());
  hdf5::File file = hdf5::File::create(path);
  file.make_group("/tools");
  file.make_group("/frame");
  file.make_group("/frame/tools");
  file.write("/tools/quads", quads, {2 * sides, 4});
  file.write("/tools/quad_tool", tool, {2 * sides});
  file.set_attribute("/tools/quad_tool", "kinds", std::string_view("die\npunch"));
  file.write("/frame/tools/outline", xyz, {4 * sides, 3});
  return file;
}

class SpaceReportTest : public ::testing::Test {
 protected:
  // Kept where the environment names a place: tests/report_in_browser.sh opens what lies there.
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    const char* const kept = std::getenv("PULVIS_KEEP_REPORTS");
    keep = kept != nullptr;
    folder = (keep ? fs::path(kept) : fs::temp_directory_path()) /
             (keep ? test->name() : "pulvis-space-" + std::to_string(getpid()) + test->name());
    fs::remove_all(folder);
  }
  void TearDown() override {
    if (!keep) fs::remove_all(folder);
  }
  std::string report_of(const testing::SyntheticSpaceRun& run) const {
    testing::record_in_space(run, folder);
    write_report(folder);
    std::ostringstream text;
    text << std::ifstream(folder / "report.html").rdbuf();
    return text.str();
  }
  static nlohmann::json head_of(const std::string& page) {
    const std::string opening = "<script type=\"application/json\" id=\"head\">";
    const auto begin = page.find(opening) + opening.size();
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  }

  fs::path folder;
  bool keep = false;
};

TEST_F(SpaceReportTest, ShowsParticlesInABox) {
  const testing::SyntheticSpaceRun run;
  const std::string page = report_of(run);
  const auto head = head_of(page);
  EXPECT_EQ(head["mesh"]["dimension"], 3);
  EXPECT_EQ(head["mesh"]["particles"], 8);
  EXPECT_EQ(head["mesh"]["cells"], 8 * testing::elements_of_sphere(run));
  EXPECT_EQ(head["frames"].size(), static_cast<std::size_t>(run.frames));
  EXPECT_EQ(head["fields"].size(), 4U);  // three of elements, one of particles
  EXPECT_EQ(head["tools"].size(), 6U);
  const auto& profile = head["frames"][0]["profile"];
  EXPECT_EQ(profile["bound"], "walls");
  double mean = 0;
  for (const double density : profile["profile"]) mean += density / 20;
  EXPECT_NEAR(mean, 0.40,
              0.03);  // balls of 24 squares each have less than pi / 6 = 0.52 of their cubes
  EXPECT_THAT(page, HasSubstr("twgl"));
}

TEST_F(SpaceReportTest, CarriesTheDensitiesOfEveryFrame) {
  const auto head = head_of(report_of({}));
  for (const auto& frame : head["frames"]) {
    const auto& grid = frame["grid"];
    ASSERT_EQ(grid["cells"].size(), 24U);
    EXPECT_TRUE(grid["cells"][0].is_null());
    EXPECT_EQ(grid["x"].size(), 4U);
    EXPECT_EQ(grid["z"].size(), 5U);
    EXPECT_EQ(grid["merged"], 1);
  }
  EXPECT_NEAR(double(head["frames"].back()["grid"]["cells"][23]), 0.6 + 0.06 + 0.02 + 0.005, 1e-5);
}

// Twelve contacts along the edges of the lattice, four at either punch.
TEST_F(SpaceReportTest, CarriesTheContactForcesOfEveryFrame) {
  testing::SyntheticSpaceRun run;
  const auto head = head_of(report_of(run));
  for (const auto& frame : head["frames"]) {
    EXPECT_EQ(frame["network"]["lines"], 12 + 8);
    EXPECT_EQ(frame["network"]["unit"], "N");
  }
  run.contacts = false;
  EXPECT_FALSE(head_of(report_of(run))["frames"][0].contains("network"));
}

TEST_F(SpaceReportTest, ShowsBondsCracksAndFragmentsInSpace) {
  EXPECT_FALSE(head_of(report_of({}))["frames"].back().contains("fragments"));
  testing::SyntheticSpaceRun run;
  run.bonds = true;
  const std::string page = report_of(run);
  const auto head = head_of(page);
  EXPECT_EQ(head["frames"][0]["bonds"], 12);
  EXPECT_EQ(head["frames"][0]["cracks"], 0);
  EXPECT_EQ(head["frames"][0]["fragments"]["count"], 1);
  const auto& middle = head["frames"][2];  // four of eight spheres have come off
  EXPECT_EQ(middle["cracks"], 8);
  EXPECT_EQ(middle["fragments"]["count"], 5);
  EXPECT_DOUBLE_EQ(middle["fragments"]["number"][3].get<double>(), 0.8);
  EXPECT_DOUBLE_EQ(middle["fragments"]["volume"][3].get<double>(), 0.5);
  EXPECT_NEAR(middle["fragments"]["diameter"].back(), std::cbrt(4) * run.diameter, 1e-8);
  for (const char* part : {"id=\"frame-0-bonds\"", "id=\"frame-4-cracks\"", "crack_area"})
    EXPECT_THAT(page, HasSubstr(part));
  std::vector<std::string> names;
  for (const auto& field : head["fields"]) names.push_back(field["name"]);
  EXPECT_THAT(names, ::testing::IsSupersetOf({"damage", "fragment"}));
}

// All bonds and cracks are counted, and at most 20,000 drawn: the page stays small.
TEST_F(SpaceReportTest, DrawsSomeOfVeryManyCracks) {
  testing::SyntheticSpaceRun run{.columns = 20, .layers = 20, .divisions = 1, .rings = 1};
  run.bonds = true;
  run.contacts = run.densities = false;
  run.frames = 2;
  const std::string page = report_of(run);
  EXPECT_EQ(head_of(page)["frames"][0]["bonds"], 3 * 20 * 20 * 19);
  EXPECT_LT(page.size(), 15'000'000U);
}

// Beside a punch with a profile the cavity is not the whole bore.
TEST_F(SpaceReportTest, EndsTheDensityAtTheDeepestPointOfAPunch) {
  const SpaceMesh mesh = block(1);
  const CrossSection bore =
      cross_section(die_and_punch(folder / "bore.h5", 2), "/frame", mesh.reference);
  EXPECT_EQ(bore.bound, "die");
  EXPECT_NEAR(bore.area, 4 * std::numbers::pi, 1e-12);
  EXPECT_FALSE(bore.bottom.has_value());
  EXPECT_DOUBLE_EQ(bore.top.value_or(0), 1.5);
}

TEST_F(SpaceReportTest, HasNoDensityAlongZInADieAlongAnotherAxis) {
  const SpaceMesh mesh = block(1);
  for (const int axis : {0, 1}) {
    const fs::path path = folder / ("lying" + std::to_string(axis) + ".h5");
    const CrossSection none = cross_section(die_and_punch(path, axis), "/frame", mesh.reference);
    EXPECT_EQ(none.bound, "die across z");
    EXPECT_TRUE(density_along_z(mesh.reference, mesh.hexahedra, none, 7).density.empty());
  }
}

TEST_F(SpaceReportTest, RefersTheDensityToTheDieOrThePowder) {
  testing::SyntheticSpaceRun run;
  run.die = true;
  EXPECT_EQ(head_of(report_of(run))["frames"][0]["profile"]["bound"], "die");
  run.tools = false;
  EXPECT_EQ(head_of(report_of(run))["frames"][0]["profile"]["bound"], "powder");
}

// What is to be mailed: 100 particles of 448 elements in 40 frames below 25 MB; sizes go with the frames.
TEST_F(SpaceReportTest, StaysBelowAQuarterOfItsLimitWithAQuarterOfTheFrames) {
  testing::SyntheticSpaceRun run{.columns = 5, .layers = 4, .divisions = 4, .rings = 4};
  run.frames = 10;
  run.samples_a_frame = 2;
  const std::string page = report_of(run);
  EXPECT_LT(page.size(), 25'000'000U / 4);
  EXPECT_FALSE(head_of(page)["mesh"]["pyramids"]);
}

TEST_F(SpaceReportTest, StandsInAComparison) {
  report_of({});
  write_comparison({folder, folder}, folder / "comparison.html");
  std::ostringstream text;
  text << std::ifstream(folder / "comparison.html").rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("twgl.js 7"));
  EXPECT_EQ(head_of(text.str())["runs"].size(), 2U);
}

}  // namespace
}  // namespace pulvis
