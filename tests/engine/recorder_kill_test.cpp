// run.h5 is whole wherever its run is killed: every write into it is noted, and the file is read as it was after
// each of them. It holds what it held before the commit or what it holds after it.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/types.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "engine/files/recorder.hpp"
#include "engine/files/run_folder.hpp"

namespace {

struct Change {
  std::string name;  // run.h5 or run.h5.journal
  std::uint64_t at = 0;
  std::string bytes;  // none: the file ends at `at` now
};

std::vector<Change>* noted = nullptr;

// The name of a file that is noted, or nothing.
std::string noted_name(int file) {
  if (noted == nullptr) return {};
  char path[4096];
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t size = readlink(link.c_str(), path, sizeof path);
  const std::string_view all(path, static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  const std::string_view name = all.substr(all.rfind('/') + 1);
  return name == "run.h5" || name == "run.h5.journal" ? std::string(name) : std::string();
}

template <class Function>
Function next_of(const char* name) {
  void* const found = dlsym(RTLD_NEXT, name);
  Function function = nullptr;
  std::memcpy(&function, &found, sizeof function);
  return function;
}

ssize_t note_write(int file, const void* bytes, std::size_t size, off_t at) {
  static const auto real = next_of<ssize_t (*)(int, const void*, std::size_t, off_t)>("pwrite64");
  const ssize_t put = real(file, bytes, size, at);
  if (const std::string name = noted_name(file); put > 0 && !name.empty())
    noted->push_back({name,
                      static_cast<std::uint64_t>(at),
                      {static_cast<const char*>(bytes), static_cast<std::size_t>(put)}});
  return put;
}

int note_truncate(int file, off_t size) {
  static const auto real = next_of<int (*)(int, off_t)>("ftruncate64");
  if (const std::string name = noted_name(file); !name.empty())
    noted->push_back({name, static_cast<std::uint64_t>(size), {}});
  return real(file, size);
}

}  // namespace

// Before those of the system's library.
extern "C" {
ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t at) {
  return note_write(file, bytes, size, at);
}
ssize_t pwrite64(int file, const void* bytes, std::size_t size, off_t at) {
  return note_write(file, bytes, size, at);
}
int ftruncate(int file, off_t size) { return note_truncate(file, size); }
int ftruncate64(int file, off_t size) { return note_truncate(file, size); }
}

namespace pulvis {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t page_bytes = 4096;

// All that a reader finds; an error where he finds none.
std::string seen(const fs::path& path) {
  const auto file = hdf5::File::open(path);
  std::ostringstream all;
  for (const std::string& group : file.children("/")) all << group << ' ';
  for (const std::string& frame : file.children("/frames")) {
    EXPECT_EQ(file.number_attribute("/frames/" + frame, "complete"), 1) << frame;
    all << frame << file.number_attribute("/frames/" + frame, "time") << ' ';
  }
  for (const std::string& dataset : file.datasets_below("/")) {
    all << dataset << file.text_attribute(dataset, "unit")
        << file.text_attribute(dataset, "meaning");
    for (const double value : file.read_doubles(dataset)) all << ' ' << value;
  }
  all << file.text_attribute("/", "title");
  if (file.has_attribute("/", "outcome")) all << file.text_attribute("/", "outcome");
  return all.str();
}

// The file at any moment: what it was, and the writes since, a page at a time.
class Replay {
 public:
  Replay(const fs::path& from, const fs::path& path)
      : path_((fs::copy_file(from, path), path)), now_(seen(path)) {}

  void apply(const Change& change) {
    if (change.name != "run.h5") return;
    if (change.bytes.empty()) {
      fs::resize_file(path_, change.at);
      look();
    }
    for (std::size_t done = 0; done < change.bytes.size();) {
      const std::uint64_t at = change.at + done;
      const std::size_t size = std::min(change.bytes.size() - done, page_bytes - at % page_bytes);
      const bool counts = at < end();
      std::fstream(path_, std::ios::in | std::ios::out | std::ios::binary)
          .seekp(static_cast<std::streamoff>(at))
          .write(change.bytes.data() + done, static_cast<std::streamsize>(size));
      done += size;
      if (counts) look();
    }
  }

  const std::vector<std::string>& states() const { return states_; }  // each one that was seen

 private:
  // Of what the file's beginning says that is in it: nobody reads behind it.
  std::uint64_t end() const {
    std::uint64_t end = 0;
    constexpr std::streamoff place = page_bytes + 40;
    std::ifstream file(path_, std::ios::binary);
    file.seekg(place).read(reinterpret_cast<char*>(&end), sizeof end);
    return end + page_bytes;
  }
  void look() {
    std::string next = seen(path_);
    if (next == now_) return;
    states_.push_back(next);
    now_ = std::move(next);
  }

  fs::path path_;
  std::string now_;
  std::vector<std::string> states_;
};

class RecorderKill : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() /
             ("pulvis-recorder-kill-" + std::to_string(getpid()) + "-" + test->name());
    fs::remove_all(folder);
    open_run_folder(folder);
  }
  void TearDown() override {
    noted = nullptr;
    fs::remove_all(folder);
  }

  static RunMesh square() {
    return {.quads = {0, 1, 2, 3},
            .cell_particle = {0},
            .node_particle = {0, 0, 0, 0},
            .reference = {0, 0, 1, 0, 1, 1, 0, 1}};
  }
  static std::vector<FieldInfo> fields() {
    return {{"position", "m", "position $x$", "where the node is", FieldPlace::node, 2},
            {"contacts/force", "N", "contact force $F$", "of the first", FieldPlace::list, 2}};
  }
  static std::vector<SeriesInfo> series() {
    return {{"tool/top/force_y", "N", "force on top $F_y$", "on the punch"}};
  }

  // Frames `first` to `last`, each after `samples` samples. What is seen after each is what a commit left.
  void go_on(Recorder& recorder, int first, int last, int samples = 2) {
    for (int k = first; k < last; ++k) {
      for (int i = 0; i < samples; ++i)
        recorder.sample(k + 1.0 * i / samples, std::vector{0.5 * i});
      auto position = square().reference;
      for (double& x : position) x += k;
      const auto contacts = static_cast<std::size_t>(k % 7 * 40);
      recorder.frame(k, 10 * k, {position, std::vector<double>(2 * contacts, k)});
      committed();
    }
  }
  void committed() {
    const std::string now = seen(folder / "run.h5");
    if (commits.empty() || now != commits.back()) commits.push_back(now);
  }
  // From here on every write is noted.
  void watch() {
    replay = std::make_unique<Replay>(folder / "run.h5", folder / "seen.h5");
    noted = &changes;
  }
  void expect_commits_and_nothing_between() {
    noted = nullptr;
    for (const Change& change : changes) replay->apply(change);
    const auto& states = replay->states();
    ASSERT_EQ(states.size(), commits.size());
    for (std::size_t i = 0; i < states.size(); ++i) EXPECT_EQ(states[i], commits[i]) << i;
  }

  // Of the file as it has been replayed so far.
  void expect_whole_repair(const std::string& journal, const std::string& after) const {
    const fs::path killed = folder / "killed";
    fs::remove_all(killed);
    fs::create_directory(killed);
    fs::copy_file(folder / "seen.h5", killed / "run.h5");
    std::ofstream(killed / "run.h5.journal", std::ios::binary) << journal;
    Replay again(killed / "run.h5", killed / "seen.h5");
    std::vector<Change> repair;
    noted = &repair;
    hdf5::File::open_to_change(killed / "run.h5").close();
    noted = nullptr;
    for (const Change& change : repair) again.apply(change);
    ASSERT_EQ(again.states().size(), 1U);
    EXPECT_EQ(again.states()[0], after);
  }

  fs::path folder;
  std::vector<Change> changes;
  std::vector<std::string> commits;
  std::unique_ptr<Replay> replay;
};

// Names of 60 frames split the groups' trees; the names of "/" come and go with every frame.
TEST_F(RecorderKill, AFrameIsThereOrNot) {
  Recorder recorder(folder, {}, square(), series(), fields());
  watch();
  go_on(recorder, 0, 60);
  recorder.finish();
  committed();
  expect_commits_and_nothing_between();
}

// Whatever an other process has written of it, nobody reads it before the commit.
TEST_F(RecorderKill, AFrameThatOthersWriteIsThereOrNot) {
  Recorder recorder(folder, {}, square(), series(), fields());
  std::optional<SharedFile> part;
  int written = 0;
  recorder.share({[](std::size_t field) { return field == 0; },
                  [&](std::size_t, const FieldRoom& room) {
                    const std::vector<double> position(8, ++written);
                    if (!part) part.emplace(room.at.file);
                    part->write(room.at.begin, std::as_bytes(std::span(position)));
                  },
                  [&] {
                    if (part) part->flush();
                    part.reset();
                  }});
  watch();
  go_on(recorder, 0, 60);
  EXPECT_GT(written, 0);
  recorder.finish();
  committed();
  expect_commits_and_nothing_between();
}

TEST_F(RecorderKill, AResumedRunIsCutAndGoesOnAtOneBlowEach) {
  RecorderPosition position;
  {
    Recorder recorder(folder, {}, square(), series(), fields());
    go_on(recorder, 0, 20);
    position = recorder.position();
    go_on(recorder, 20, 33);
  }
  commits.clear();
  watch();
  for (int round = 0; round < 4; ++round) {  // the last one ends, and is resumed no more
    Recorder recorder(folder, square(), series(), fields(), position);
    committed();
    go_on(recorder, static_cast<int>(position.frames), 26 + 3 * round);
    recorder.sample(100, std::vector{1.0});
    const RecorderPosition reached = recorder.position();
    committed();
    if (round % 2 == 1) position = reached;
    if (round == 3)
      recorder.image({"map/height", "m", "height $z$", "of the flank"}, 8, 100,
                     std::vector<double>(800, round));
    recorder.finish(round == 3 ? "done" : "stopped");
    committed();
  }
  expect_commits_and_nothing_between();
}

// The commit was ready, and its pages are put in place anew: what was seen before or after it is seen.
TEST_F(RecorderKill, ARepairThatIsKilledLeavesWhatItFoundOrWhatItMakes) {
  Recorder recorder(folder, {}, square(), series(), fields());
  watch();
  go_on(recorder, 0, 24);
  noted = nullptr;
  int repairs = 0;
  std::string journal;
  for (const Change& change : changes) {
    if (change.name == "run.h5.journal") {
      if (change.at == 0) journal.clear();
      journal += change.bytes;
    } else if (!journal.empty()) {  // the first page is to be put in place
      const std::size_t states = replay->states().size();
      if (states % 4 == 0) expect_whole_repair(journal, commits.at(states));
      repairs += states % 4 == 0;
      journal.clear();
    }
    replay->apply(change);
  }
  EXPECT_EQ(repairs, 6);
}

// Beyond a megabyte the history is written anew now and then only.
TEST_F(RecorderKill, ALongHistoryIsThereOrNot) {
  Recorder recorder(folder, {}, square(), series(), fields());
  watch();
  go_on(recorder, 0, 6, 9000);
  recorder.position();
  committed();
  recorder.finish();
  committed();
  expect_commits_and_nothing_between();
}

}  // namespace
}  // namespace pulvis
