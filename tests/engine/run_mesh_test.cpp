// What run.h5 has once, beside the mesh: numbers of the particles, and the tools as a mesh of lines of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/files/recorder.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

// Three quads of two particles, and two triangles as tools, the second of which comes down.
class RunMeshTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("pulvis-run-mesh-" + std::to_string(getpid()));
    fs::remove_all(folder);
    open_run_folder(folder);
    const RunMesh mesh{
        .quads = {0, 1, 3, 2, 2, 3, 5, 4, 6, 7, 9, 8},
        .cell_particle = {0, 0, 1},
        .node_particle = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1},
        .reference = {0, 0, 1, 0, 0, 1, 1, 1, 0, 2, 1, 2, 2, 0, 3, 0, 2, 1, 3, 1},
        .tags = {{"number", "particle", "of the particle", {0, 1}, {}},
                 {"material", "material", "position", {1, 0}, {"iron", "copper & <tin>"}}},
        .tools = {{"left", "top"}, {0, 1, 1, 2, 2, 0, 3, 4, 4, 5, 5, 3}, {0, 0, 0, 1, 1, 1}}};
    Recorder recorder(
        folder, {"0.1.0", "abc", "tagged", "f00d", 1, 1}, mesh, {},
        {{"position", "m", "position $x$", "of the node", FieldPlace::node, 2},
         {"tools/outline", "m", "outlines of the tools $x$", "corners", FieldPlace::list, 2}});
    for (int k = 0; k < 3; ++k) {
      recorder.sample(k, {});
      recorder.frame(k, k,
                     {mesh.reference, {-1, 0, 0, 0, 0, 3, 0, 5.0 - k, 1, 5.0 - k, 1, 6.0 - k}});
    }
    recorder.finish();
  }
  void TearDown() override { fs::remove_all(folder); }

  int python(const std::string& script) const {
    std::ofstream(folder / "read.py") << script;
    return std::system(
        ("/usr/bin/python3 '" + (folder / "read.py").string() + "' '" + folder.string() + "'")
            .c_str());
  }

  fs::path folder;
};

TEST_F(RunMeshTest, KeepsWhatParticlesAreOnceAndWithNames) {
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_THAT(file.children("/particles"), ElementsAre("material", "number"));
  EXPECT_THAT(file.read_integers("/particles/material"), ElementsAre(1, 0));
  EXPECT_EQ(file.text_attribute("/particles/material", "names"), "iron\ncopper & <tin>");
  EXPECT_EQ(file.text_attribute("/particles/material", "place"), "particle");
  EXPECT_THAT(file.read_integers("/mesh/cell_material"), ElementsAre(1, 1, 0));
  EXPECT_EQ(file.text_attribute("/tools/line_tool", "names"), "left\ntop");
  EXPECT_THAT(file.children("/frames/000000"), ElementsAre("position", "tools"));
}

// A hexahedron and, as tools, a square below it and a triangle beside it that goes away.
TEST_F(RunMeshTest, ShowsParticlesAndToolsInSpaceToMeshio) {
  fs::remove_all(folder);
  open_run_folder(folder);
  RunMesh mesh;
  mesh.cell_particle = {0};
  mesh.node_particle.assign(8, 0);
  mesh.reference = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  mesh.hexahedra = {0, 1, 2, 3, 4, 5, 6, 7};
  mesh.tags = {{"material", "material", "position", {1}, {"iron", "tin"}}};
  mesh.tool_faces = {{"floor", "wall"}, {"plane", "stl"}, {0, 1, 2, 3, 4, 5, 6, 6}, {0, 1}, 7};
  {
    Recorder recorder(
        folder, {"0.1.0", "abc", "in space", "f00d", 1, 1}, mesh, {},
        {{"position", "m", "position $x$", "of the node", FieldPlace::node, 3},
         {"tools/outline", "m", "outlines of the tools $x$", "corners", FieldPlace::list, 3}});
    for (int k = 0; k < 2; ++k) {
      const double x = 1.0 + k;
      recorder.frame(k, k, {mesh.reference, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,  //
                                             x, 0, 0, x, 0, 1, x, 1, 0}});
    }
    recorder.finish();
  }
  EXPECT_EQ(python(R"(
import sys, pathlib, meshio
folder = pathlib.Path(sys.argv[1])
with meshio.xdmf.TimeSeriesReader(folder / "run.xdmf") as powder:
    points, cells = powder.read_points_cells()
    assert cells[0].type == "hexahedron" and points.shape == (8, 3) and powder.num_steps == 2
    _, _, at_cells = powder.read_data(1)
    assert at_cells["material"][0].tolist() == [1] and at_cells["particle"][0].tolist() == [0]
tools, powder = (folder / "run.xdmf").read_text().split('<Grid Name="run"')
(folder / "tools.xdmf").write_text(tools + "</Domain>\n</Xdmf>\n")
with meshio.xdmf.TimeSeriesReader(folder / "tools.xdmf") as tools:
    tools.read_points_cells()
    for step in range(2):
        tools.mesh_grid = tools.collection[step]
        points, cells = tools.read_points_cells()
        assert cells[0].type == "quad" and cells[0].data.tolist() == [[0, 1, 2, 3], [4, 5, 6, 6]], cells
        assert points[4:, 0].tolist() == [1 + step] * 3, points
        assert tools.read_data(step)[2]["tool"][0].tolist() == [0, 1]
)"),
            0);
}

TEST_F(RunMeshTest, ShowsParticlesAndToolsToMeshio) {
  EXPECT_EQ(python(R"(
import sys, re, pathlib, meshio
folder = pathlib.Path(sys.argv[1])
with meshio.xdmf.TimeSeriesReader(folder / "run.xdmf") as powder:
    points, cells = powder.read_points_cells()
    assert powder.num_steps == 3 and cells[0].type == "quad" and points.shape == (10, 2)
    for step in range(3):
        time, at_nodes, at_cells = powder.read_data(step)
        assert time == step
        assert at_cells["material"][0].tolist() == [1, 1, 0], at_cells
        assert at_cells["particle"][0].tolist() == [0, 0, 1]
# meshio reads the last series of a file: the tools stand before the powder.
text = (folder / "run.xdmf").read_text()
tools, powder = text.split('<Grid Name="run"')
(folder / "tools.xdmf").write_text(tools + "</Domain>\n</Xdmf>\n")
with meshio.xdmf.TimeSeriesReader(folder / "tools.xdmf") as tools:
    tools.read_points_cells()
    assert tools.num_steps == 3
    for step in range(3):
        tools.mesh_grid = tools.collection[step]
        points, cells = tools.read_points_cells()
        assert points[3:, 1].tolist() == [5 - step, 5 - step, 6 - step], points
        assert cells[0].type == "line" and cells[0].data.shape == (6, 2), cells
        time, _, at_cells = tools.read_data(step)
        assert time == step and at_cells["tool"][0].tolist() == [0, 0, 0, 1, 1, 1]
)"),
            0);
}

}  // namespace
}  // namespace pulvis
