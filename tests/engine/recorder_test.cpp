// The recorder: what it writes can be read back, in the places and with the units the users'
// scripts rely on; what the machine refuses becomes an OutputError that tells file and reason.
#include "engine/files/recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "engine/files/output_error.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two squares side by side, each a particle of one quad.
RunMesh two_squares() {
  return {.quads = {0, 1, 2, 3, 4, 5, 6, 7},
          .cell_particle = {0, 1},
          .node_particle = {0, 0, 0, 0, 1, 1, 1, 1},
          .reference = {0, 0, 1, 0, 1, 1, 0, 1, 2, 0, 3, 0, 3, 1, 2, 1}};
}

std::vector<FieldInfo> four_fields() {
  return {
      {"position", "m", "position $x$", "where the node is", FieldPlace::node, 2},
      {"velocity", "m/s", "velocity $v$", "how fast it moves", FieldPlace::node, 2},
      {"effective_stress", "Pa", "effective stress $\\sigma_\\mathrm{eff}$", "von Mises",
       FieldPlace::cell, 1},
      {"contacts", "-", "edges or faces in contact", "edges in contact", FieldPlace::particle, 1}};
}

std::vector<SeriesInfo> two_series() {
  return {{"tool/top/force_y", "N", "force on top $F_y$", "force on the punch"},
          {"relative_density", "-", "relative density $\\rho$", "solid share"}};
}

constexpr double third = 1.0 / 3.0;

class RecorderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() /
             ("pulvis-recorder-" + std::to_string(getpid()) + "-" + test->name());
    fs::remove_all(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  // Frame k at time k: everything moved by k in x, stress 100 k and 100 k + 1.
  static std::vector<std::vector<double>> fields_of(int k) {
    auto position = two_squares().reference;
    for (std::size_t i = 0; i < position.size(); i += 2) position[i] += k;
    return {position, std::vector<double>(16, k), {100.0 * k, 100.0 * k + 1}, {1, 2}};
  }

  void record(int frames, bool finish = true) const {
    open_run_folder(folder);
    Recorder recorder(folder, {"0.1.0", "abc", "Two <squares>", "f00d", 18446744073709551615U, 2},
                      two_squares(), two_series(), four_fields());
    for (int k = 0; k < frames; ++k) {
      recorder.sample(k, std::vector{k * third, 0.5});
      recorder.sample(k + 0.5, std::vector{k * third + 1e-9, 0.75});
      recorder.frame(k, 1000 * k, fields_of(k));
    }
    if (finish) recorder.finish();
  }

  std::string text_of(const char* name) const {
    std::ostringstream text;
    text << std::ifstream(folder / name).rdbuf();
    return text.str();
  }

  fs::path folder;
};

TEST_F(RecorderTest, LaysTheFileOutAsPromised) {
  record(2);
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_THAT(file.children("/"), ElementsAre("frames", "history", "mesh"));
  EXPECT_EQ(file.shape("/mesh/quads"), (hdf5::Shape{2, 4}));
  EXPECT_EQ(file.shape("/mesh/reference"), (hdf5::Shape{8, 2}));
  EXPECT_EQ(file.read_integers("/mesh/quads"), two_squares().quads);
  EXPECT_EQ(file.read_integers("/mesh/cell_particle"), two_squares().cell_particle);
  EXPECT_EQ(file.read_integers("/mesh/node_particle"), two_squares().node_particle);
  EXPECT_THAT(file.children("/frames"), ElementsAre("000000", "000001"));
  EXPECT_EQ(file.shape("/frames/000001/position"), (hdf5::Shape{8, 2}));
  EXPECT_EQ(file.shape("/frames/000001/effective_stress"), (hdf5::Shape{2}));
  EXPECT_EQ(file.read_doubles("/frames/000001/effective_stress"), (std::vector{100.0, 101.0}));
  EXPECT_EQ(file.shape("/history/tool/top/force_y"), (hdf5::Shape{4}));
}

TEST_F(RecorderTest, WritesTheAttributesOfTheRun) {
  record(1);
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_EQ(file.text_attribute("/", "version"), "0.1.0");
  EXPECT_EQ(file.text_attribute("/", "commit"), "abc");
  EXPECT_EQ(file.text_attribute("/", "title"), "Two <squares>");
  EXPECT_EQ(file.text_attribute("/", "scene_hash"), "f00d");
  EXPECT_EQ(file.text_attribute("/", "outcome"), "done");
  EXPECT_EQ(file.unsigned_attribute("/", "seed"), 18446744073709551615U);
  EXPECT_EQ(file.number_attribute("/", "threads"), 2);
}

TEST_F(RecorderTest, GivesEveryDatasetAUnitAndAMeaningAndResultsALabel) {
  record(2);
  const auto file = hdf5::File::open(folder / "run.h5");
  const auto datasets = file.datasets_below("/");
  EXPECT_EQ(datasets.size(), 4U + 2 * 4U + 3U);
  for (const auto& dataset : datasets) {
    EXPECT_FALSE(file.text_attribute("/" + dataset, "unit").empty()) << dataset;
    EXPECT_FALSE(file.text_attribute("/" + dataset, "meaning").empty()) << dataset;
  }
  EXPECT_EQ(file.text_attribute("/history/tool/top/force_y", "unit"), "N");
  EXPECT_EQ(file.text_attribute("/history/tool/top/force_y", "label"), "force on top $F_y$");
  EXPECT_EQ(file.text_attribute("/frames/000001/velocity", "label"), "velocity $v$");
  EXPECT_EQ(file.text_attribute("/frames/000001/velocity", "unit"), "m/s");
  EXPECT_EQ(file.text_attribute("/history/time", "unit"), "s");
}

TEST_F(RecorderTest, MarksFramesCompleteAndSaysWhenAndAtWhichStep) {
  record(3);
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_EQ(file.number_attribute("/frames/000002", "complete"), 1);
  EXPECT_EQ(file.number_attribute("/frames/000002", "time"), 2);
  EXPECT_EQ(file.number_attribute("/frames/000002", "step"), 2000);
}

TEST_F(RecorderTest, StoresPlaneVectorsWithAThirdComponentOfZero) {
  record(2);
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_EQ(file.shape("/frames/000001/velocity"), (hdf5::Shape{8, 3}));
  EXPECT_EQ(file.number_attribute("/frames/000001/velocity", "components"), 2);
  const auto velocity = file.read_doubles("/frames/000001/velocity");
  for (std::size_t i = 0; i < velocity.size(); ++i) EXPECT_EQ(velocity[i], i % 3 == 2 ? 0 : 1);
}

TEST_F(RecorderTest, WritesTheSameHistoryAsCsvToTheLastBit) {
  record(3);
  const auto file = hdf5::File::open(folder / "run.h5");
  const auto time = file.read_doubles("/history/time");
  const auto force = file.read_doubles("/history/tool/top/force_y");
  std::istringstream csv(text_of("history.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "time [s],tool/top/force_y [N],relative_density [-]");
  std::size_t row = 0;
  for (; std::getline(csv, line); ++row) {
    const auto comma = line.find(',');
    ASSERT_LT(row, time.size());
    EXPECT_EQ(std::stod(line), time[row]);
    EXPECT_EQ(std::stod(line.substr(comma + 1)), force[row]);
  }
  EXPECT_EQ(row, time.size());
  EXPECT_EQ(row, 6U);
}

TEST_F(RecorderTest, KeepsSamplesThatComeAfterTheLastFrame) {
  open_run_folder(folder);
  {
    Recorder recorder(folder, {}, two_squares(), two_series(), four_fields());
    recorder.sample(0, std::vector{1.0, 2.0});
    recorder.frame(0, 0, fields_of(0));
    recorder.sample(1, std::vector{3.0, 4.0});
  }  // not finished: the destructor closes
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_THAT(file.read_doubles("/history/tool/top/force_y"), ElementsAre(1.0, 3.0));
  EXPECT_FALSE(file.has_attribute("/", "outcome"));
}

TEST_F(RecorderTest, LeavesAFrameReadableWhileTheRunGoesOn) {
  open_run_folder(folder);
  Recorder recorder(folder, {}, two_squares(), two_series(), four_fields());
  recorder.sample(0, std::vector{1.0, 2.0});
  recorder.frame(0, 0, fields_of(0));
  fs::copy_file(folder / "run.h5", folder / "as-after-a-kill.h5");  // nothing is closed yet
  const auto file = hdf5::File::open(folder / "as-after-a-kill.h5");
  EXPECT_EQ(file.number_attribute("/frames/000000", "complete"), 1);
  EXPECT_THAT(file.read_doubles("/history/time"), ElementsAre(0.0));
  EXPECT_THAT(text_of("history.csv"), HasSubstr("\n0,1,2\n"));
}

// Beyond the first hundred, frames that come fast share a commit. Whoever looks on sees whole ones.
TEST_F(RecorderTest, ManyFastFramesAreAllThereWhenTheRunIsSavedOrEnds) {
  constexpr int maximum = 600;
  open_run_folder(folder);
  Recorder recorder(folder, {}, two_squares(), two_series(), four_fields());
  for (int k = 0; k < maximum; ++k) {
    recorder.sample(k, std::vector{1.0, 2.0});
    recorder.frame(k, k, fields_of(k));
    if (k % 97 != 0) continue;
    const auto file = hdf5::File::open(folder / "run.h5");
    const auto frames = file.children("/frames");
    EXPECT_LE(frames.size(), static_cast<std::size_t>(k) + 1);
    EXPECT_GE(frames.size(), std::min(static_cast<std::size_t>(k) + 1, std::size_t{100}));
    for (const std::string& frame : frames)
      EXPECT_EQ(file.number_attribute("/frames/" + frame, "complete"), 1);
    EXPECT_EQ(file.shape("/history/time").front(), frames.size());
  }
  EXPECT_EQ(recorder.position().frames, maximum);
  EXPECT_EQ(hdf5::File::open(folder / "run.h5").children("/frames").size(), std::size_t{maximum});
  EXPECT_THAT(text_of("run.xdmf"), HasSubstr("/frames/000599/position"));
  recorder.finish();
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_EQ(file.children("/frames").size(), std::size_t{maximum});
  EXPECT_EQ(file.read_doubles("/frames/000599/effective_stress"), fields_of(maximum - 1)[2]);
  EXPECT_EQ(file.number_attribute("/frames/000400", "time"), 400);
}

TEST_F(RecorderTest, RefusesWrongLengthsAndAFirstFieldThatIsNoPosition) {
  open_run_folder(folder);
  Recorder recorder(folder, {}, two_squares(), two_series(), four_fields());
  EXPECT_THROW(recorder.sample(0, std::vector{1.0}), std::invalid_argument);
  auto fields = fields_of(0);
  fields[2].push_back(0);
  EXPECT_THROW(recorder.frame(0, 0, fields), std::invalid_argument);
  recorder.finish();
  EXPECT_THAT(hdf5::File::open(folder / "run.h5").children("/"),
              ElementsAre("frames", "history", "mesh"));  // nothing of it is left
  EXPECT_THROW(Recorder(folder / "b", {}, two_squares(), {}, {four_fields()[2]}),
               std::invalid_argument);
}

TEST_F(RecorderTest, RefusesAFolderThatHoldsARunUnlessToldToReplaceIt) {
  record(1);
  std::ofstream(folder / "notes.txt") << "mine";
  EXPECT_THROW(open_run_folder(folder), RunFolderTaken);
  EXPECT_TRUE(fs::exists(folder / "run.h5"));
  open_run_folder(folder, true);
  EXPECT_FALSE(fs::exists(folder / "run.h5"));
  EXPECT_FALSE(fs::exists(folder / "run.xdmf"));
  EXPECT_TRUE(fs::exists(folder / "notes.txt"));
}

TEST_F(RecorderTest, SaysWhyAFolderCannotBeMadeAndLeavesNothingBehind) {
  std::ofstream(folder) << "a file where the folder should be";
  try {
    open_run_folder(folder / "run");
    FAIL() << "was not refused";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.path(), folder / "run");
    EXPECT_EQ(error.reason(), "Not a directory");
  }
  EXPECT_THROW(open_run_folder(folder), OutputError);
  EXPECT_TRUE(fs::is_regular_file(folder));
  EXPECT_THROW(open_run_folder("/proc/pulvis/run"), OutputError);
}

TEST_F(RecorderTest, SaysWhatTheSystemSaidWhereTheFolderIsMissing) {
  try {
    Recorder recorder(folder, {}, two_squares(), two_series(), four_fields());
    FAIL() << "was not refused";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.path(), folder / "run.h5.new");
    EXPECT_EQ(error.reason(), "No such file or directory");
  }
}

// A child process with a file-size limit stands for a full disk: the same failing write().
TEST_F(RecorderTest, TurnsAFullDiskIntoAnErrorAndKeepsTheFramesBefore) {
  const auto write_until_full = [this] {
    const rlimit limit{100'000, 100'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      record(1000);
    } catch (const OutputError& error) {
      std::exit(error.reason() == "File too large" ? 4 : 1);
    }
  };
  EXPECT_EXIT(write_until_full(), ::testing::ExitedWithCode(4), "^$");
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_EQ(file.number_attribute("/frames/000000", "complete"), 1);
}

TEST_F(RecorderTest, WritesAnXdmfThatMeshioReadsAsATimeSeries) {
  record(3);
  std::ofstream(folder / "read.py") << R"(
import sys, meshio
with meshio.xdmf.TimeSeriesReader(sys.argv[1]) as reader:
    points, cells = reader.read_points_cells()
    assert reader.num_steps == 3, reader.num_steps
    assert points.shape == (8, 2), points.shape
    assert len(cells) == 1 and cells[0].type == "quad" and cells[0].data.shape == (2, 4), cells
    for step in range(3):
        time, nodes, quads = reader.read_data(step)
        assert time == step
        assert quads["effective_stress"][0].tolist() == [100 * step, 100 * step + 1]
        assert quads["particle"][0].tolist() == [0, 1]
        assert nodes["velocity"].shape == (8, 3)
        assert nodes["velocity"][7].tolist() == [step, step, 0]
        assert "contacts" not in nodes and "contacts" not in quads
)";
  const std::string command = "/usr/bin/python3 '" + (folder / "read.py").string() + "' '" +
                              (folder / "run.xdmf").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(RecorderTest, WritesAnXdmfThatIsWellFormedAfterEveryFrame) {
  record(2, false);
  const std::string check =
      "import sys, xml.dom.minidom as m; d = m.parse(sys.argv[1]); "
      "assert len(d.getElementsByTagName(\\\"Grid\\\")) == 3";
  const std::string command =
      "/usr/bin/python3 -c \"" + check + "\" '" + (folder / "run.xdmf").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_FALSE(fs::exists(folder / "run.xdmf.new"));
}

// A reader of run.xdmf is not sent to frames that are gone.
TEST_F(RecorderTest, AResumedRunTakesFramesThatItCutsOutOfTheXdmf) {
  RecorderPosition position;
  open_run_folder(folder);
  {
    Recorder recorder(folder, {}, two_squares(), two_series(), four_fields());
    for (int k = 0; k < 5; ++k) {
      recorder.frame(k, k, fields_of(k));
      if (k == 2) position = recorder.position();
    }
  }
  EXPECT_THAT(text_of("run.xdmf"), HasSubstr("/frames/000004/"));
  const Recorder resumed(folder, two_squares(), two_series(), four_fields(), position);
  EXPECT_THAT(hdf5::File::open(folder / "run.h5").children("/frames"),
              ElementsAre("000000", "000001", "000002"));
  EXPECT_THAT(text_of("run.xdmf"), HasSubstr("/frames/000002/"));
  EXPECT_EQ(text_of("run.xdmf").find("/frames/000003/"), std::string::npos);
  EXPECT_THAT(hdf5::File::open(folder / "run.vtkhdf").shape("/VTKHDF/Steps/Values"),
              ElementsAre(3));
}

// The newest frame first, vectors and places in the plane with a third component; read through run.h5.
TEST_F(RecorderTest, ViewsOfAllFramesAreReadFromRunH5) {
  record(3);
  const auto file = hdf5::File::open(folder / "run.vtkhdf");
  EXPECT_EQ(file.shape("/VTKHDF/Points"), (hdf5::Shape{24, 3}));
  const std::vector<double> stress = file.read_doubles("/VTKHDF/CellData/effective_stress");
  EXPECT_THAT(stress, ElementsAre(200, 201, 100, 101, 0, 1));
  EXPECT_THAT(file.read_doubles("/VTKHDF/Steps/CellDataOffsets/effective_stress"),
              ElementsAre(4, 2, 0));
  EXPECT_THAT(file.read_doubles("/VTKHDF/Types"), ElementsAre(9, 9));
  EXPECT_THAT(file.read_integers("/VTKHDF/CellData/particle"), ElementsAre(0, 1));
  const std::vector<double> points = file.read_doubles("/VTKHDF/Points");
  for (std::size_t i = 2; i < points.size(); i += 3) EXPECT_EQ(points[i], 0);
}

// Lists of their own length: none in the first frame, then two rows; no part of the XDMF picture.
// Rows come between frames, none is lost or twice where a run was stopped, and whole numbers are stored as such.
TEST_F(RecorderTest, TablesGrowAndGoOnWhereTheRunWasSaved) {
  const std::vector<TableInfo> tables{
      {"cracks",
       {{"time", "s", "time $t$", "when"}, {"particle", "-", "particle", "its number", true}}}};
  RecorderPosition position;
  open_run_folder(folder);
  {
    Recorder recorder(folder, {}, two_squares(), two_series(), four_fields(), simulated_time,
                      tables);
    EXPECT_EQ(hdf5::File::open(folder / "run.h5").shape("/cracks/time"), (hdf5::Shape{0}));
    for (int k = 0; k < 5; ++k) {
      recorder.row(0, std::vector{third * k, 7.0 + k});
      EXPECT_EQ(recorder.rows(0), k + 1);
      if (k == 1) recorder.frame(k, k, fields_of(k));
      if (k == 2) position = recorder.position();
    }
    EXPECT_THROW(recorder.row(0, std::vector{1.0}), std::invalid_argument);
    recorder.finish();
  }
  EXPECT_EQ(hdf5::File::open(folder / "run.h5").shape("/cracks/time"), (hdf5::Shape{5}));
  Recorder resumed(folder, two_squares(), two_series(), four_fields(), position, simulated_time,
                   tables);
  EXPECT_EQ(resumed.rows(0), 3);
  resumed.row(0, std::vector{0.5, 2147483647.0});
  resumed.finish();
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_THAT(file.read_doubles("/cracks/time"), ElementsAre(0, third, 2 * third, 0.5));
  EXPECT_THAT(file.read_integers("/cracks/particle"), ElementsAre(7, 8, 9, 2147483647));
  EXPECT_EQ(file.text_attribute("/cracks/time", "unit"), "s");
  EXPECT_THAT(file.children("/"), ElementsAre("cracks", "frames", "history", "mesh"));
}

TEST_F(RecorderTest, WritesListsWhoseLengthChanges) {
  open_run_folder(folder);
  auto fields = four_fields();
  fields.push_back(
      {"contacts/ids", "-", "bodies in contact", "who touches", FieldPlace::list, 2, true});
  fields.push_back(
      {"contacts/force", "N", "contact force $F$", "of the first", FieldPlace::list, 2});
  fields.front().name = "position";
  fields[3].name = "touching";
  Recorder recorder(folder, {}, two_squares(), two_series(), fields);
  for (int k = 0; k < 2; ++k) {
    auto values = fields_of(k);
    values.push_back(k == 0 ? std::vector<double>() : std::vector<double>{0, 1, 1, 2147483647});
    values.push_back(k == 0 ? std::vector<double>() : std::vector<double>{1, third, -2, 4});
    recorder.frame(k, k, values);
  }
  auto broken = fields_of(2);
  broken.insert(broken.end(), {{1, 2}, {1, 2, 3}});  // half a row
  EXPECT_THROW(recorder.frame(2, 2, broken), std::invalid_argument);
  recorder.finish();
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_EQ(file.shape("/frames/000000/contacts/ids"), (hdf5::Shape{0, 2}));
  EXPECT_THAT(file.read_doubles("/frames/000000/contacts/force"), ElementsAre());
  EXPECT_EQ(file.shape("/frames/000001/contacts/force"), (hdf5::Shape{2, 2}));
  EXPECT_THAT(file.read_integers("/frames/000001/contacts/ids"), ElementsAre(0, 1, 1, 2147483647));
  EXPECT_THAT(file.read_doubles("/frames/000001/contacts/force"), ElementsAre(1, third, -2, 4));
  EXPECT_EQ(file.text_attribute("/frames/000001/contacts/force", "place"), "list");
  EXPECT_EQ(text_of("run.xdmf").find("contacts/"), std::string::npos);
}

}  // namespace
}  // namespace pulvis
