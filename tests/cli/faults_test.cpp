// When the machine fails a run: exit code 4, a message that names file and reason, and every frame that was
// written before can be read. What was stopped goes on as soon as the cause is gone.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "engine/files/hdf5.hpp"
#include "engine/files/output_error.hpp"
#include "scenes/memory_need.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class Faults : public ProgramTest {
 protected:
  // Writes some 60 kB a frame.
  Words long_run() const {
    return {"run",       scene("compaction/regular-25.toml"),
            "-o",        "run",
            "--threads", "1",
            "--set",     "stage.press.duration=80 us",
            "--set",     "stage.press.move[0].displacement=[\"0 mm\", \"-1.6 mm\"]",
            "--set",     "output.frames=100",
            "--set",     "output.samples=100"};
  }

  // Returns how many frames there are, each of them whole.
  std::size_t whole_frames() const {
    const auto file = hdf5::File::open(place / "run" / "run.h5");
    const auto frames = file.children("/frames");
    for (const std::string& frame : frames) {
      EXPECT_EQ(file.number_attribute("/frames/" + frame, "complete"), 1);
      EXPECT_FALSE(file.read_doubles("/frames/" + frame + "/position").empty());
    }
    EXPECT_GE(file.read_doubles("/history/time").size(), frames.size());
    return frames.size();
  }

  static bool may_mount() {
    return std::system("unshare -m mount -t tmpfs none /mnt 2>/dev/null") == 0;
  }

  // Runs the program where `mount` has mounted what nobody else sees, and `after` before that is gone.
  Outcome mounted(const std::string& mount, const Words& words,
                  const std::string& after = "true") const {
    std::string command = "cd '" + place.string() + "' && unshare -m sh -c '" + mount +
                          " && { \"$@\" >out 2>err; code=$?; " + after + "; exit $code; }' sh '" +
                          paths::program() + "'";
    for (const std::string& word : words) command += " '" + word + "'";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), text_of(place / "out"), text_of(place / "err")};
  }

  // Of a file that is being written: a look between two writes of a commit may not be able to read it.
  std::size_t frames_so_far() const {
    try {
      return hdf5::File::open(place / "run" / "run.h5").children("/frames").size();
    } catch (const std::exception&) {
      return 0;
    }
  }
  void wait_for_frames(std::size_t count) const {
    for (int tries = 0; tries < 6000; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (frames_so_far() >= count) return;
    }
    FAIL() << "there were no " << count << " frames within half a minute";
  }
};

TEST_F(Faults, AFileSizeLimitStopsTheRunAndItGoesOnWithoutIt) {
  const Outcome end = pulvis(long_run(), "ulimit -f 12000");  // of 512 bytes: 6 MB
  EXPECT_EQ(end.code, 4) << end.err;
  EXPECT_THAT(end.err, ContainsRegex("run.h5: cannot [a-z]+ .*: File too large"));
  EXPECT_THAT(end.err, HasSubstr("pulvis resume run"));
  EXPECT_GT(whole_frames(), 5U);
  EXPECT_LT(whole_frames(), 101U);
  const Outcome rest = pulvis({"resume", "run"});
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(whole_frames(), 101U);
}

// The limit lies between the sizes of run.h5 (some 90 kB) and of the page (some 220 kB).
constexpr const char* too_small_for_a_report = "ulimit -f 300";  // of 512 bytes: 150 kB

Words short_spin() {
  return {"--threads",       "1",     "--set",           "stage.spin.duration=0.1 ms", "--set",
          "output.frames=1", "--set", "output.samples=2"};
}

TEST_F(Faults, AReportThatCannotBeWrittenIsWrittenLater) {
  const Words run = with({"run", scene("basic/spinning-disc.toml"), "-o", "run"}, short_spin());
  const Outcome end = pulvis(run, too_small_for_a_report);
  EXPECT_EQ(end.code, 4) << end.err;
  EXPECT_THAT(end.err, HasSubstr("report.html: cannot write: File too large"));
  EXPECT_THAT(end.err, HasSubstr("pulvis report run"));
  EXPECT_THAT(end.err, Not(HasSubstr("pulvis resume")));
  EXPECT_THAT(text_of(place / "run" / "summary.json"), HasSubstr("\"outcome\": \"done\""));
  EXPECT_FALSE(fs::exists(place / "run" / "report.html"));
  const Outcome report = pulvis({"report", "run"});
  EXPECT_EQ(report.code, 0) << report.err;
  EXPECT_TRUE(fs::exists(place / "run" / "report.html"));
}

TEST_F(Faults, WithoutItsReportAFailedRunIsCompleteAndAnInterruptedOneIsNot) {
  const Words run = with({"run", scene("basic/spinning-disc.toml"), "-o", "run"}, short_spin());
  const Outcome failed =
      pulvis(with(run, {"--set", "limits.energy_balance=1e-14"}), too_small_for_a_report);
  EXPECT_EQ(failed.code, 4) << failed.err;
  EXPECT_THAT(failed.err, HasSubstr("the run failed: energies: energy_balance"));
  EXPECT_THAT(failed.err, HasSubstr("pulvis report run"));
  const Outcome stopped =
      pulvis(with(run, {"--overwrite", "--stop-after", "100"}), too_small_for_a_report);
  EXPECT_EQ(stopped.code, 4) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("pulvis resume run"));
  EXPECT_THAT(stopped.err, Not(HasSubstr("pulvis report")));
}

// A file system of 5 MB of the run's own; needs the right to mount one.
TEST_F(Faults, AFullFileSystemKeepsTheFramesBefore) {
  if (!may_mount()) GTEST_SKIP() << "may not mount";
  fs::create_directory(place / "run");
  const Outcome end =
      mounted("mount -t tmpfs -o size=5m none run", long_run(), "cp run/run.h5 saved.h5");
  EXPECT_EQ(end.code, 4) << end.err;
  EXPECT_THAT(end.err, HasSubstr("No space left on device"));
  fs::rename(place / "saved.h5", place / "run" / "run.h5");
  EXPECT_GT(whole_frames(), 5U);
}

// The advice, followed to the letter once there is room.
TEST_F(Faults, AfterAFullFileSystemTheAdviceIsNotRefused) {
  if (!may_mount()) GTEST_SKIP() << "may not mount";
  fs::create_directory(place / "run");
  for (const int kilobytes : {4, 8, 12, 16, 40, 160, 400, 1000}) {
    const std::string mount = fmt::format("mount -t tmpfs -o size={}k none run", kilobytes);
    const Outcome end = mounted(mount, short_run("run/r"),
                                "mount -o remount,size=50m run; "
                                "if grep -q \"resume run/r\" err; then \"$1\" resume run/r; "
                                "elif grep -q overwrite err; then \"$@\" --overwrite; "
                                "else grep -q \"again in the same way\" err && \"$@\"; fi "
                                ">out2 2>err2; echo $? >code2");
    EXPECT_EQ(end.code, 4) << kilobytes << " kB: " << end.err;
    EXPECT_EQ(text_of(place / "code2"), "0\n")
        << kilobytes << " kB: " << end.err << text_of(place / "err2");
  }
}

TEST_F(Faults, AFolderMountedReadOnlyIsNamed) {
  if (!may_mount()) GTEST_SKIP() << "may not mount";
  fs::create_directory(place / "run");
  const Outcome end = mounted("mount -t tmpfs -o ro none run", long_run());
  EXPECT_EQ(end.code, 4) << end.err;
  EXPECT_THAT(end.err, ContainsRegex("run[/a-z.0-9-]*: cannot .*: Read-only file system"));
  EXPECT_TRUE(fs::is_empty(place / "run"));
}

// The disk of a run that was stopped comes back read-only: its frames can be read, and it goes on as soon as
// it may write again.
TEST_F(Faults, AStoppedRunMountedReadOnlyKeepsItsFrames) {
  if (!may_mount()) GTEST_SKIP() << "may not mount";
  ASSERT_EQ(pulvis(long_run(), "ulimit -f 6000").code, 4);
  const std::size_t frames = whole_frames();
  EXPECT_GT(frames, 2U);
  const Outcome end =
      mounted("mount --bind run run && mount -o remount,bind,ro run", {"resume", "run"});
  EXPECT_EQ(end.code, 4) << end.err;
  EXPECT_THAT(end.err, ContainsRegex("run[/a-z.0-9-]*: cannot .*: Read-only file system"));
  EXPECT_EQ(whole_frames(), frames);
  const Outcome rest = pulvis({"resume", "run"});
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(whole_frames(), 101U);
}

TEST_F(Faults, AFolderThatVanishesIsNamed) {
  const pid_t child = start(long_run());
  wait_for_frames(3);
  fs::rename(place / "run", place / "gone");  // at once: nothing is written in between
  const Outcome end = end_of(child);
  EXPECT_EQ(end.code, 4) << end.err;
  EXPECT_THAT(end.err,
              ContainsRegex("run/[a-z.0-9-]+: cannot .*: (No such file or directory|it is no "
                            "longer there)"));
}

// ---- bits that flip on the disk --------------------------------------------------------------------
class Damage : public Faults {
 protected:
  // Flips the lowest bit of the largest value of a dataset. The values stand in the file as they are in memory.
  void damage(const std::string& dataset) const {
    const fs::path path = place / "run" / "run.h5";
    const std::vector<double> values = hdf5::File::open(path).read_doubles(dataset);
    const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                                 values.size() * sizeof(double));
    const std::string text = text_of(path);
    const std::size_t at = text.find(bytes);
    ASSERT_NE(at, std::string::npos) << dataset;
    const auto largest = std::ranges::max_element(values) - values.begin();
    const auto byte = static_cast<std::streamoff>(at) + 8 * largest;
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(byte);
    file.put(static_cast<char>(text[static_cast<std::size_t>(byte)] ^ 1));
  }
  Words stopped_run() const {
    return short_run("run", {"--stop-after", "150", "--threads", "1", "--overwrite"});
  }
};

TEST_F(Damage, EveryDatasetOfARunHasAChecksum) {
  ASSERT_EQ(pulvis(short_run("run")).code, 0);
  const auto file = hdf5::File::open(place / "run" / "run.h5");
  const std::vector<std::string> datasets = file.datasets_below("/");
  EXPECT_GT(datasets.size(), 50U);
  for (const std::string& name : datasets) {
    const bool empty = std::ranges::count(file.shape("/" + name), 0U) > 0;
    EXPECT_TRUE(empty || file.has_attribute("/" + name, "xxh3")) << name;
  }
  EXPECT_EQ(file.damaged_datasets(), std::vector<std::string>());
}

TEST_F(Damage, ResumeTellsWhatIsLostOfAFrameAndGoesOn) {
  ASSERT_EQ(pulvis(stopped_run()).code, 130);
  damage("/frames/000001/velocity");
  const Outcome rest = pulvis({"resume", "run"});
  EXPECT_EQ(rest.code, 4) << rest.err;
  EXPECT_THAT(rest.err, ContainsRegex("warning: run/run.h5: /frames/000001/velocity: .*checksum.*"
                                      "'velocity' is lost for the frame at t = 5[.0-9]*e-06 s"));
  EXPECT_THAT(rest.err, HasSubstr("the results in run are complete, but the report is missing"));
  const auto file = hdf5::File::open(place / "run" / "run.h5");
  EXPECT_EQ(file.text_attribute("/", "outcome"), "done");
  EXPECT_THAT(file.damaged_datasets(), ::testing::ElementsAre("/frames/000001/velocity"));
}

TEST_F(Damage, ResumeDoesNotContinueADamagedHistory) {
  ASSERT_EQ(pulvis(stopped_run()).code, 130);
  damage("/history/tool/top/force_y");
  const std::string before = text_of(place / "run" / "run.h5");
  const Outcome rest = pulvis({"resume", "run"});
  EXPECT_EQ(rest.code, 4) << rest.err;
  EXPECT_THAT(rest.err, ContainsRegex("run/run.h5: cannot continue: /history/tool/top/force_y: "
                                      ".*checksum.*it is lost"));
  EXPECT_TRUE(text_of(place / "run" / "run.h5") == before);
}

TEST_F(Damage, ReportsAndFiguresNameWhatIsLost) {
  ASSERT_EQ(pulvis(short_run("run")).code, 0);
  damage("/frames/000002/position");
  const Outcome report = pulvis({"report", "run"});
  EXPECT_EQ(report.code, 4) << report.err;
  EXPECT_THAT(report.err, ContainsRegex("run.h5: cannot read /frames/000002/position: .*lost"));
  const Outcome figure = pulvis({"figure", "run", "--series", "tool/top/force_y", "-o", "f.csv"});
  EXPECT_EQ(figure.code, 4) << figure.err;
  EXPECT_THAT(figure.err, ContainsRegex("run/run.h5: /frames/000002/position: .*lost"));
  EXPECT_TRUE(fs::exists(place / "f.csv"));
}

// The root's machine holds the results, too; the others only their ranks' shares.
TEST_F(Faults, EveryMachineOfARunNeedsTheMemoryOfItsRanks) {
  const Scene large = read_scene(scene("compaction/hexagonal-1683.toml"));
  const MemoryNeed need = memory_need(large);
  const std::uint64_t shared = need.columns + need.contacts, plenty = 100 * need.total();
  const auto told = [&](std::uint64_t first, std::uint64_t second, std::uint64_t each) {
    try {
      require_memory(large, {{"node1", 1, first, plenty}, {"node2", 3, second, each}});
      return std::string();
    } catch (const OutputError& error) {
      return error.reason();
    }
  };
  const std::uint64_t first = shared / 4 + need.program + need.results,
                      second = shared * 3 / 4 + 3 * need.program;
  EXPECT_EQ(told(first + 2, second + 2, second), "");
  EXPECT_THAT(told(first - 1000, second + 2, second),
              ContainsRegex("it needs about .* of memory on node1 for 1 of its 4 ranks, but only"));
  EXPECT_THAT(told(first + 2, second - 1000, second), HasSubstr("on node2 for 3 of its 4 ranks"));
  EXPECT_THAT(told(first + 2, second + 2, shared / 4), HasSubstr("on node2 for 1 of its 4 ranks"));
}

TEST_F(Faults, TooLittleMemoryIsRefusedBeforeTheFolderIsMade) {
  const Outcome end = pulvis({"run", scene("compaction/hexagonal-1683.toml"), "-o", "run"},
                             "ulimit -v 250000");  // kB
  EXPECT_EQ(end.code, 4) << end.err;
  EXPECT_THAT(end.err,
              ContainsRegex("hexagonal-1683.toml: cannot run it: it needs about [0-9.]+ MB "
                            "of memory, but only [0-9.]+ MB are available"));
  EXPECT_FALSE(fs::exists(place / "run"));
  // A million particles of 204 quads: no machine of today's has it; refused at once.
  const Outcome huge = pulvis({"run", scene("compaction/hexagonal-1683.toml"), "-o", "run", "--set",
                               "packing[0].rows=900", "--set", "packing[0].columns=900"});
  EXPECT_EQ(huge.code, 4) << huge.err;
  EXPECT_FALSE(fs::exists(place / "run"));
}

// A run of so many frames that it is at work whenever the file goes.
TEST_F(Faults, ASceneThatVanishesIsNamedAndTheRunGoesOnOnceItIsBack) {
  const pid_t child = start({"run", scene("compaction/regular-25.toml"), "-o", "run", "--threads",
                             "1", "--set", "output.frames=50000", "--checkpoint-every", "0.01"});
  wait_for_frames(3);
  fs::rename(place / "run" / "scene.toml", place / "kept.toml");
  const Outcome end = end_of(child);
  EXPECT_EQ(end.code, 4) << end.err;
  EXPECT_THAT(end.err,
              HasSubstr("run/scene.toml: cannot continue without the file: it is no longer there"));
  fs::rename(place / "kept.toml", place / "run" / "scene.toml");
  const Outcome rest = pulvis({"resume", "run", "--stop-after", "1"});
  EXPECT_EQ(rest.code, 130) << rest.err;
}

// What is promised before is what the world then takes.
TEST(MemoryNeed, ColumnsAreThoseOfTheWorld) {
  for (const char* name : {"compaction/regular-100.toml", "basic/oblique-impact.toml",
                           "shear/grooves-16.toml", "basic/traced-grain.toml",
                           "compaction-3d/one-sphere.toml", "compaction-3d/random-100-316L.toml"}) {
    Experiment e(name);
    double fixed = 0, rows = 0;
    for (const ColumnBase* column : e.simulation.world().columns())
      (column->entity.ends_with("contact") ? rows : fixed) += static_cast<double>(column->bytes());
    const MemoryNeed need = memory_need(e.scene);
    EXPECT_NEAR(static_cast<double>(need.columns), fixed, 0.06 * fixed) << name;
  }
}

TEST(MemoryNeed, ContactRowsOfADensePowderAreWithin) {
  Experiment e(
      "compaction/regular-25.toml",
      {"stage.press.duration=0.2 ms", "stage.press.move[0].displacement=[\"0 mm\", \"-8 mm\"]"});
  e.simulation.run_until(e.simulation.clock().end);
  double rows = 0;
  for (const ColumnBase* column : e.simulation.world().columns())
    if (column->entity.ends_with("contact")) rows += static_cast<double>(column->bytes());
  const auto promised = static_cast<double>(memory_need(e.scene).contacts);
  EXPECT_LT(rows, promised);
  EXPECT_GT(rows, 0.2 * promised);
}

// Of a row: what the columns of bonds add to the others.
TEST(MemoryNeed, RowsGrowByTheirColumnsOfBonds) {
  const auto bond = [](const char* origin, const char* keys) {
    return fmt::format("[[bond]]\nbetween = [\"316L\", \"316L\"]\norigin = \"{}\"\n{}\n", origin,
                       keys);
  };
  const std::string law = "strength = \"10 MPa\"\nfracture_energy = \"50 J/m^2\"\n";
  const std::string glue = bond("initial", law.c_str());
  const std::string weld = bond("pressed", (law + "threshold = \"5 MPa\"\ngrowth = 0.1").c_str());
  const std::string dust = bond("adhesion", "work = \"0.1 J/m^2\"\nrange = \"1 um\"");
  struct Rows {
    double bytes, promised;
  };
  const auto rows_with = [](const std::string& bonds) {
    Experiment e(own_scene("extends = \"" + paths::source_dir() +
                           "/scenes/compaction/regular-25.toml\"\n" + bonds));
    double bytes = 0;
    for (const ColumnBase* column : e.simulation.world().columns())
      if (column->entity == Contact::name) bytes += static_cast<double>(column->row_bytes);
    return Rows{bytes, static_cast<double>(memory_need(e.scene).contacts)};
  };
  const Rows plain = rows_with("");
  for (const std::string& bonds : {glue, weld, dust, glue + weld + dust}) {
    const Rows bonded = rows_with(bonds);
    EXPECT_GT(bonded.bytes, plain.bytes);
    EXPECT_NEAR(bonded.promised / plain.promised, bonded.bytes / plain.bytes, 1e-9) << bonds;
  }
}

}  // namespace
}  // namespace pulvis
