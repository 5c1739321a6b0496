// A run that was stopped and goes on gives the same bits as one that was not: history, frames, final state.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "engine/files/checkpoint.hpp"
#include "engine/files/hdf5.hpp"
#include "tests/helpers/left.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

struct Course {
  const char* name;
  const char* scene;
  Words changes;
  std::int64_t end;  // step at which all are compared; 0: the run's end
  std::vector<std::pair<std::int64_t, int>> stops;  // step, threads until then
};

void PrintTo(const Course& course, std::ostream* out) { *out << course.name; }

class ResumeTest : public ProgramTest {
 protected:
  Left left_in(const std::string& folder) const { return pulvis::left_in(place / folder); }

  Words run_words(const Course& course, const std::string& folder) const {
    Words words{"run", scene(course.scene), "-o", folder};
    for (const std::string& change : course.changes) {
      words.push_back("--set");
      words.push_back(change);
    }
    return words;
  }

  static Words until(Words words, std::int64_t step, int threads) {
    words.insert(words.end(), {"--threads", std::to_string(threads)});
    if (step > 0) words.insert(words.end(), {"--stop-after", std::to_string(step)});
    return words;
  }

  std::vector<fs::path> checkpoints(const std::string& folder) const {
    return checkpoints_in(place / folder);
  }
};

// 25 particles that touch, slide and flow plastically within the first 500 of 980 steps.
const Words fast_punch{"stage.press.duration=80 us",
                       "stage.press.move[0].displacement=[\"0 mm\", \"-1.6 mm\"]",
                       "output.frames=8", "output.samples=40"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

class Courses : public ResumeTest, public ::testing::WithParamInterface<Course> {};

TEST_P(Courses, GoOnBitByBit) {
  const Course& course = GetParam();
  const int code = course.end > 0 ? 130 : 0;
  const Outcome whole = pulvis(until(run_words(course, "whole"), course.end, 1));
  ASSERT_EQ(whole.code, code) << whole.err;
  Words words = run_words(course, "parts");
  for (const auto& [step, threads] : course.stops) {
    const Outcome part = pulvis(until(words, step, threads));
    ASSERT_EQ(part.code, 130) << part.err;
    EXPECT_THAT(part.err, HasSubstr("continue with: pulvis resume parts"));
    words = {"resume", "parts"};
  }
  const Outcome last = pulvis(until(words, course.end, 2));
  ASSERT_EQ(last.code, code) << last.err;
  EXPECT_THAT(last.out, HasSubstr("resumed at step"));
  expect_same(left_in("whole"), left_in("parts"));
}

// Steps 1 and 2 are within the first contact search; the others fall between samples.
INSTANTIATE_TEST_SUITE_P(
    Of, Courses,
    ::testing::Values(
        Course{"Compaction",
               "compaction/regular-25.toml",
               with(fast_punch, {"output.contacts=true", "output.density_cells=[3, 3]"}),
               0,
               {{1, 1}, {2, 2}, {333, 1}, {601, 2}}},
        Course{"FourPointsAndHighestMode",
               "compaction/regular-25.toml",
               with(fast_punch, {"element.formulation=four-point", "time.estimate=highest-mode"}),
               0,
               {{400, 2}}},
        Course{"StiffContacts",
               "compaction/regular-25.toml",
               with(fast_punch, {"contact.stiffness=12", "contact.hardness=3"}),
               0,
               {{1, 1}, {333, 2}, {601, 1}}},
        Course{"BulkDamping",
               "compaction/regular-25.toml",
               with(fast_punch, {"material.316L.damping.mass_proportional=1e5 1/s",
                                 "material.316L.damping.stiffness_proportional=2 ns"}),
               0,
               {{400, 2}}},
        Course{"ServoAndGrooves",
               "shear/grooves-16.toml",
               {"stage.load.duration=0.05 ms", "stage.shear.duration=0.1 ms",
                "stage.load.servo[0].tolerance=1e6", "stage.shear.servo[0].tolerance=1e6",
                "stage.load.servo[0].max_speed=20 m/s", "stage.shear.servo[0].max_speed=20 m/s",
                "output.samples=60", "output.frames=6"},
               1500,
               {{150, 1}, {613, 2}, {900, 1}}},
        Course{"Constraints",
               "basic/tension.toml",
               {"output.samples=60", "output.frames=6"},
               1200,
               {{100, 1}, {701, 2}}},
        Course{"BlocksThatTearApart",  // from one side on, from step 302 to 432
               "bonds/pulled-blocks.toml",
               {"stage.pull.duration=20 us", "tool.head.low=[\"0.4 mm\", \"1.4 mm\"]",
                "stage.pull.move[0].displacement=[\"0 mm\", \"0.04 mm\"]", "output.samples=40",
                "output.frames=6"},
               700,
               {{310, 1}, {311, 2}, {370, 1}, {425, 2}}},
        Course{"Breaking",  // at step 1700 to 1950
               "bonds/sheared-blocks.toml",
               {"stage.pull.duration=30 us",
                "stage.pull.move.head.displacement=[\"0.012 mm\", \"0.004 mm\"]",
                "bond[0].weibull_modulus=5", "output.samples=60", "output.frames=6"},
               2500,
               {{1, 1}, {900, 2}, {1500, 1}, {1790, 2}, {1840, 1}, {1870, 2}}},
        Course{"Welding",
               "bonds/cold-weld.toml",
               {"stage.press.duration=20 us", "stage.part.duration=40 us", "output.samples=60",
                "output.frames=6"},
               16000,
               {{2, 1}, {6000, 2}, {11000, 1}, {13000, 2}}},
        Course{"FrictionLoop", "afm/loop-beam-0.toml", {}, 0, {{1, 1}, {3, 1}, {9, 2}, {30, 1}}}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_F(ResumeTest, CheckpointsFollowTheSimulatedTime) {
  const Course course{"", "compaction/regular-25.toml", fast_punch, 0, {}};
  Words words = with(run_words(course, "run"), {"--checkpoint-time", "10 us"});
  ASSERT_EQ(pulvis(until(words, 600, 1)).code, 130);  // some 35 us
  const auto files = checkpoints("run");              // the newest first: that of the stop
  ASSERT_EQ(files.size(), 2U);
  const double stopped = Checkpoint(files[0]).info().time;
  EXPECT_GT(stopped, 30e-6);
  EXPECT_LT(stopped, 40e-6);
  EXPECT_NEAR(Checkpoint(files[1]).info().time, 30e-6, 0.2e-6);
  const Outcome wrong = pulvis(with(run_words(course, "no"), {"--checkpoint-time", "10 mm"}));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err + wrong.out, HasSubstr("--checkpoint-time"));
  EXPECT_EQ(
      pulvis({"run", scene("afm/loop-beam-0.toml"), "-o", "afm", "--checkpoint-time", "1 s"}).code,
      2);
}

// ---- killed -----------------------------------------------------------------------------------------
class KilledRun : public ResumeTest {
 protected:
  const Course course{"", "compaction/regular-25.toml", fast_punch, 0, {}};

  // Killed as soon as so many checkpoints have been written.
  void kill_after(const std::string& folder, int signal, const Words& more = {}) const {
    Words words = with(run_words(course, folder), {"--threads", "1", "--checkpoint-steps", "100"});
    const pid_t child = start(with(words, more));
    for (int tries = 0; tries < 6000 && checkpoints_in(place / folder).size() < 2; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(child, signal);
    EXPECT_EQ(end_of(child).code, 128 + signal);
    EXPECT_EQ(checkpoints_in(place / folder).size(), 2U);
  }

  Left uninterrupted() const {
    EXPECT_EQ(pulvis(until(run_words(course, "whole"), 0, 1)).code, 0);
    return left_in("whole");
  }

  // In the middle of the file.
  static void flip_byte(const fs::path& file) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    const auto middle = static_cast<std::streamoff>(fs::file_size(file) / 2);
    stream.seekg(middle);
    const char byte = static_cast<char>(stream.get() ^ 16);
    stream.seekp(middle);
    stream.put(byte);
  }
};

TEST_F(KilledRun, GoesOnFromItsNewestCheckpointAndLosesNothing) {
  kill_after("killed", SIGKILL);
  {  // closed before the program goes on with it
    const auto file = hdf5::File::open(place / "killed" / "run.h5");
    for (const std::string& frame : file.children("/frames"))
      EXPECT_EQ(file.number_attribute("/frames/" + frame, "complete"), 1) << frame;
  }
  const Outcome end = pulvis({"resume", "killed", "--threads", "2"});
  ASSERT_EQ(end.code, 0) << end.err;
  expect_same(uninterrupted(), left_in("killed"));
  EXPECT_TRUE(checkpoints("killed").empty());  // nothing is left to go on with
}

TEST_F(KilledRun, ADamagedCheckpointIsNamedAndTheOneBeforeIsUsed) {
  kill_after("flipped", SIGKILL);
  const fs::path newest = checkpoints("flipped").front(), before = checkpoints("flipped").back();
  flip_byte(newest);
  const Outcome end = pulvis({"resume", "flipped"});
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_THAT(end.err, HasSubstr(newest.filename().string() + " is damaged: "));
  EXPECT_THAT(end.out, HasSubstr("resumed at step " +
                                 std::to_string(std::stoll(before.stem().string().substr(11)))));
  expect_same(uninterrupted(), left_in("flipped"));
}

TEST_F(KilledRun, AShortenedCheckpointIsDamagedToo) {
  kill_after("short", SIGKILL);
  for (const fs::path& file : checkpoints("short")) fs::resize_file(file, fs::file_size(file) / 3);
  const Outcome end = pulvis({"resume", "short"});
  EXPECT_EQ(end.code, 4);
  EXPECT_THAT(end.err, HasSubstr("there is no intact checkpoint"));
}

TEST_F(KilledRun, AnotherRunsCheckpointIsLeftAside) {
  ASSERT_EQ(pulvis(until(run_words(course, "one"), 50, 1)).code, 130);
  Course other = course;
  other.changes.push_back("contact.friction=0.17");
  ASSERT_EQ(pulvis(until(run_words(other, "other"), 60, 1)).code, 130);
  fs::copy(checkpoints("other").front(), place / "one");
  const Outcome end = pulvis({"resume", "one"});
  ASSERT_EQ(end.code, 0) << end.err;
  expect_same(uninterrupted(), left_in("one"));
}

TEST_F(KilledRun, AnotherScenesCheckpointIsRefused) {
  ASSERT_EQ(pulvis(until(run_words(course, "one"), 50, 1)).code, 130);
  std::string scene = text_of(place / "one/scene.toml");
  const auto title = scene.find("title = \"");
  ASSERT_NE(title, std::string::npos);
  scene.insert(title + 9, "Not that: ");
  std::ofstream(place / "one/scene.toml") << scene;
  const Outcome end = pulvis({"resume", "one"});
  EXPECT_EQ(end.code, 2);
  EXPECT_THAT(end.err, HasSubstr("the checkpoint belongs to another scene"));
}

TEST_F(KilledRun, AnotherVersionsCheckpointIsRefused) {
  ASSERT_EQ(pulvis(until(run_words(course, "run"), 50, 1)).code, 130);
  const auto info = Checkpoint(checkpoints("run").front()).info();
  write_checkpoint(place / "run", {"0.0.1", "0ld", info.scene_hash, 999, 1e-6, info.run}, World(),
                   {});
  const Outcome end = pulvis({"resume", "run"});
  EXPECT_EQ(end.code, 2);
  EXPECT_THAT(end.err, HasSubstr("was written by pulvis 0.0.1 (0ld)"));
}

TEST_F(KilledRun, AFolderWithoutARunOrCheckpointIsRefused) {
  fs::create_directory(place / "empty");
  const Outcome empty = pulvis({"resume", "empty"});
  EXPECT_EQ(empty.code, 2);
  EXPECT_THAT(empty.err, HasSubstr("there is no run"));
  Course brief = course;
  brief.changes = {"stage.press.duration=20 us",
                   "stage.press.move[0].displacement=[\"0 mm\", \"-0.4 mm\"]"};
  ASSERT_EQ(pulvis(run_words(brief, "done")).code, 0);
  const Outcome done = pulvis({"resume", "done"});
  EXPECT_EQ(done.code, 2);
  EXPECT_THAT(done.err, HasSubstr("cannot resume: the run is finished"));
}

// ---- two at once, and somebody who looks on -----------------------------------------------------------
TEST_F(KilledRun, ASecondRunInTheFolderIsRefusedWhileTheFirstWrites) {
  const pid_t first = start(
      with(run_words(course, "shared"), {"--threads", "1", "--set", "stage.press.duration=8 ms"}));
  for (int tries = 0; tries < 6000 && !fs::exists(place / "shared" / "run.h5"); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  for (const Words& words :
       {with(run_words(course, "shared"), {"--overwrite"}), Words{"resume", "shared"}}) {
    const Outcome second = pulvis(words);
    EXPECT_EQ(second.code, 2);
    EXPECT_THAT(second.err, HasSubstr("another run is writing into it"));
  }
  kill(first, SIGTERM);
  EXPECT_EQ(end_of(first).code, 130);
}

// h5py, as users have it, with the file locks that it takes by default. The run is halted for each look,
// so that none spans a commit however slow the reader is.
TEST_F(KilledRun, ResultsCanBeReadWhileTheRunWrites) {
  const pid_t child = start(with(run_words(course, "watched"),
                                 {"--threads", "1", "--set", "stage.press.duration=400 us", "--set",
                                  "output.frames=1000", "--set", "output.samples=1000"}));
  const fs::path script = place / "look.py";
  // It may have been halted in the middle of a commit: such a look fails, and one of the next does not.
  std::ofstream(script) << R"(import h5py, os, signal, sys, time
writer = int(sys.argv[1])
def halted():
    return open('/proc/%d/stat' % writer).read().rpartition(')')[2].split()[0] in 'TZ'
seen, failed = set(), []
for tries in range(6000):
    if len(seen) > 15 or len(failed) > 99: break
    time.sleep(0.01)
    if not os.path.exists('watched/run.h5'): continue
    os.kill(writer, signal.SIGSTOP)
    while not halted(): time.sleep(0.001)
    try:
        with h5py.File('watched/run.h5', 'r') as f:
            for name, frame in f['frames'].items():
                if frame is None: raise KeyError(name)  # h5py's way to say that a link leads nowhere yet
                assert frame.attrs['complete'] == 1, name
                assert frame['position'][...].shape[1] == 2, name
            seen.add(len(f['frames']))
        failed = []
    except (OSError, RuntimeError, KeyError) as error:
        failed.append(repr(error))
    os.kill(writer, signal.SIGCONT)
sys.exit(0 if len(seen) > 15 else 'saw %s frames, then failed with %s' % (sorted(seen), failed))
)";
  const std::string command =
      "cd '" + place.string() + "' && /usr/bin/python3 look.py " + std::to_string(child) + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  kill(child, SIGCONT);
  kill(child, SIGTERM);
  EXPECT_THAT(end_of(child).code, ::testing::AnyOf(0, 130));
}

}  // namespace
}  // namespace pulvis
