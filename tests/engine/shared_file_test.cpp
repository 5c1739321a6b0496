// Files that several processes write: the bytes come where room was made for them, a failure is not forgotten, and a run's
// file is the same as that of a process which writes it alone.
#include "engine/files/shared_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <optional>
#include <sstream>

#include "engine/files/output_error.hpp"
#include "engine/files/recorder.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

class SharedFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() /
             ("pulvis-shared-" + std::to_string(getpid()) + "-" + test->name());
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  static void put(SharedFile& file, std::uint64_t at, const std::vector<double>& values) {
    file.write(at, std::as_bytes(std::span(values)));
  }

  fs::path folder;
};

TEST_F(SharedFileTest, PartsOfSeveralWritersComeToTheirPlaces) {
  const fs::path path = folder / "parts";
  std::ofstream(path) << "..............";
  SharedFile one(path), other(path);
  const auto put = [](SharedFile& file, std::uint64_t at, std::string_view text) {
    file.write(at, std::as_bytes(std::span(text)));
  };
  put(one, 2, "ab");
  put(other, 6, "xy");
  put(one, 4, "cd");
  put(one, 10, "ef");
  one.flush();
  other.flush();
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(), "..abcdxy..ef..");
}

TEST_F(SharedFileTest, AFailureIsToldAgainAtEveryCall) {
  SharedFile full("/dev/full");
  put(full, 0, {1, 2});
  for (int i = 0; i < 2; ++i) {
    try {
      full.flush();
      ADD_FAILURE() << "flushed";
    } catch (const OutputError& error) {
      EXPECT_EQ(error.reason(), "No space left on device");
      EXPECT_EQ(error.path(), "/dev/full");
    }
  }
  EXPECT_THROW(SharedFile(folder / "none"), OutputError);
}

TEST_F(SharedFileTest, OnlyFileSystemsWithOneViewAreShared) {
  EXPECT_TRUE(has_one_view(folder));
  EXPECT_FALSE(has_one_view(folder / "none"));
}

TEST_F(SharedFileTest, RoomIsWhereReadersFindTheValues) {
  const fs::path path = folder / "room.h5";
  auto file = hdf5::File::create(path, 512);
  const auto begin = file.make_room("/a/values", hdf5::Number::real, {2, 3});
  const auto bytes = file.make_room("/a/bytes", hdf5::Number::byte, {5});
  EXPECT_EQ(file.make_room("/a/none", hdf5::Number::real, {0, 3}), 0U);
  SharedFile part(path);
  put(part, *begin + 3 * sizeof(double), {4, 5, 6});
  put(part, *begin, {1, 2, 3});
  part.write(*bytes, std::as_bytes(std::span(std::string_view("bytes"))));
  part.flush();
  file.close();
  const auto read = hdf5::File::open(path);
  EXPECT_EQ(read.shape("/a/values"), (hdf5::Shape{2, 3}));
  EXPECT_EQ(read.read_doubles("/a/values"), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read.read_bytes("/a/bytes", 1, 3),
            (std::vector{std::byte{'y'}, std::byte{'t'}, std::byte{'e'}}));
  EXPECT_EQ(read.shape("/a/none"), (hdf5::Shape{0, 3}));
}

// Free space before the end of the last commit may share a page with what a commit changes: no other process writes there.
TEST_F(SharedFileTest, NoRoomIsMadeInWhatWasCommitted) {
  const fs::path path = folder / "run.h5";
  {
    auto made = hdf5::File::create_to_change(path, 4096);
    made.make_group("/mesh");
    made.flush();
  }
  auto file = hdf5::File::open_to_change(path);
  file.begin_change();
  file.write("/old", std::vector<double>(400, 1.0), {400});
  file.write("/later", std::vector<double>(10, 1.0), {10});
  file.commit_change();
  file.begin_change();
  file.remove("/old");
  file.commit_change();
  const std::uint64_t committed = fs::file_size(path);
  int refused = 0;
  file.begin_change();
  for (int i = 0; i < 20; ++i) {
    const std::string name = "/new" + std::to_string(i);
    const auto begin = file.make_room(name, hdf5::Number::real, {100});
    if (begin) {
      EXPECT_GE(*begin, committed);
    } else {
      EXPECT_FALSE(file.contains(name));
      ++refused;
      file.write(name, std::vector<double>(100, 2.0), {100});
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 20);  // what is free is soon filled
}

// Three particles of 200 quads each, the outer two written by one writer and the middle one by another.
class SharedRun : public SharedFileTest {
 protected:
  static constexpr int quads =
      200;  // enough that fields do not fit into space that commits leave free
  static RunMesh mesh() {
    RunMesh mesh;
    for (int q = 0; q < 3 * quads; ++q) {
      for (int k = 0; k < 4; ++k) {
        mesh.quads.push_back(4 * q + k);
        mesh.node_particle.push_back(q / quads);
        mesh.reference.insert(mesh.reference.end(), {1.0 * q, 0.1 * k});
      }
      mesh.cell_particle.push_back(q / quads);
    }
    return mesh;
  }
  static std::vector<FieldInfo> fields() {
    return {{"position", "m", "position $x$", "where the node is", FieldPlace::node, 2},
            {"velocity", "m/s", "velocity $v$", "how fast it moves", FieldPlace::node, 2},
            {"stress", "Pa", "stress $\\sigma$", "in the plane", FieldPlace::cell, 4},
            {"contacts/force", "N", "contact force $F$", "of the first", FieldPlace::list, 1}};
  }
  static std::vector<double> values_of(std::size_t field, int frame) {
    constexpr std::array<std::size_t, 4> sizes{24 * quads, 24 * quads, 12 * quads, 5};
    std::vector<double> values;
    for (std::size_t i = 0; i < sizes.at(field); ++i)
      values.push_back(100.0 * frame + 10.0 * static_cast<double>(field) +
                       0.1 * static_cast<double>(i));
    return values;
  }

  FieldWriters writers() {
    return {[](std::size_t field) { return field < 3; },
            [this](std::size_t field, const FieldRoom& room) {
              const std::vector<double> all = values_of(field, frame_);
              const std::size_t columns = static_cast<std::size_t>(room.components);
              const std::size_t rows = all.size() / columns / 3;
              for (const std::size_t particle : {0, 2, 1}) {
                auto& part = particle == 1 ? middle_ : outer_;
                if (!part) part.emplace(room.at.file);
                std::vector<double> own(
                    all.begin() + static_cast<std::ptrdiff_t>(particle * rows * columns),
                    all.begin() + static_cast<std::ptrdiff_t>((particle + 1) * rows * columns));
                if (room.stored != room.components) own = with_zero_third(own);
                put(*part, room.at.begin + particle * own.size() * sizeof(double), own);
              }
              ++shared_;
            },
            [this] {
              for (auto* part : {&outer_, &middle_}) {
                if (*part) (*part)->flush();
                part->reset();
              }
            }};
  }

  void record(const fs::path& place, bool shares) {
    open_run_folder(place);
    Recorder recorder(place, {}, mesh(), {{"force", "N", "force $F$", "on the punch"}}, fields());
    if (shares) recorder.share(writers());
    for (frame_ = 0; frame_ < 130; ++frame_) {  // the last ones without a commit each
      recorder.sample(frame_, std::vector{0.5 * frame_});
      recorder.frame(frame_, frame_, [&](std::size_t field) { return values_of(field, frame_); });
    }
    recorder.finish();
  }

  int frame_ = 0, shared_ = 0;
  std::optional<SharedFile> outer_, middle_;
};

TEST_F(SharedRun, HoldsTheSameAsThatOfOneProcess) {
  record(folder / "alone", false);
  record(folder / "shared", true);
  EXPECT_GT(shared_,
            3 * 100);  // fields; some come into free space, and are written by the recorder
  const auto alone = hdf5::File::open(folder / "alone" / "run.h5"),
             shared = hdf5::File::open(folder / "shared" / "run.h5");
  const std::vector<std::string> datasets = alone.datasets_below("/");
  EXPECT_EQ(shared.datasets_below("/"), datasets);
  for (const std::string& dataset : datasets) {
    EXPECT_EQ(shared.read_doubles("/" + dataset), alone.read_doubles("/" + dataset)) << dataset;
    EXPECT_EQ(shared.shape("/" + dataset), alone.shape("/" + dataset)) << dataset;
    for (const char* name : {"unit", "meaning"})
      EXPECT_EQ(shared.text_attribute("/" + dataset, name),
                alone.text_attribute("/" + dataset, name));
  }
}

// The frame that could not be written is not there; those before are.
TEST_F(SharedRun, AFrameThatAWriterCouldNotWriteIsNotThere) {
  open_run_folder(folder);
  {
    Recorder recorder(folder, {}, mesh(), {{"force", "N", "force $F$", "on the punch"}}, fields());
    FieldWriters failing = writers();
    failing.write = [this, write = failing.write](std::size_t field, const FieldRoom& room) {
      if (frame_ == 2 && field == 1) throw OutputError(room.at.file, "write its part", "full");
      write(field, room);
    };
    recorder.share(failing);
    const auto values = [&](std::size_t field) { return values_of(field, frame_); };
    for (; frame_ < 2; ++frame_) recorder.frame(frame_, frame_, values);
    EXPECT_THROW(recorder.frame(frame_, frame_, values), OutputError);
  }
  const auto file = hdf5::File::open(folder / "run.h5");
  EXPECT_EQ(file.children("/frames").size(), 2U);
  EXPECT_EQ(file.read_doubles("/frames/000001/stress"), values_of(2, 1));
}

}  // namespace
}  // namespace pulvis
