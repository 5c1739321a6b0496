// A checkpoint gives a world back bit by bit, whoever added its columns; one that was changed is recognised.
#include "engine/files/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <optional>
#include <sstream>

#include "engine/files/output_error.hpp"
#include "tests/engine/test_places.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using namespace engine_test;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// A resource that only ever is what the scene makes it.
struct Drawing {
  static constexpr const char* resource_name = "drawing";
  static constexpr bool fixed = true;
};
struct Memory {
  static constexpr const char* resource_name = "memory";
  std::vector<std::string> words;
  std::optional<double> last;
  std::vector<std::pair<double, int>> pairs;
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(words, last, pairs);
  }
};
static_assert(IsFixed<Drawing> && !HasState<Drawing>);
static_assert(HasState<Memory> && !IsFixed<Memory>);
struct Careless {  // neither: World::emplace and Write refuse to compile with it
  double time = 0;
};
static_assert(!HasState<Careless> && !IsFixed<Careless>);

class CheckpointTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() /
             ("pulvis-checkpoint-" + std::to_string(getpid()) + "-" + test->name());
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  static void make(World& world) {
    world.add_table<Cell>(std::vector<std::int32_t>{2, 1});
    world.add_table<Link>(std::size_t{0});
    world.add<Heat>();
    world.add<Passing>();
    world.add<Ends>();
    world.add<Force>();
    world.emplace<Clockwork>();
    world.emplace<Drawing>();
    world.emplace<Memory>();
  }

  static void fill(World& world) {
    auto& heat = world.column<Heat>();
    for (std::size_t i = 0; i < heat.bytes() / sizeof(double); ++i)
      heat.values()[i] = 1.0 / static_cast<double>(i + 3);
    world.rebuild<Link>({-1, -1, -1});
    for (int i = 0; i < 6; ++i) world.column<Ends>().values()[i] = 7 * i;
    for (int i = 0; i < 3; ++i) world.column<Force>().values()[i] = -0.1 * i;
    world.resource<Clockwork>().time = 0.3;
    world.resource<Memory>() = {{"a", "", "long word"}, 0.1 + 0.2, {{1e-300, 4}}};
  }

  static std::string bytes_of(const ColumnBase& column) {
    return {reinterpret_cast<const char*>(column.data()), column.bytes()};
  }

  void write(std::int64_t step) {
    World world;
    make(world);
    fill(world);
    write_checkpoint(folder, {"0.1", "abc", "f00d", step, 2.5}, world,
                     {{"own", std::vector<std::byte>(3, std::byte{9})}});
  }

  std::string content(const fs::path& file) const {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  fs::path folder;
};

// Each column in two parts, the second one first.
TEST_F(CheckpointTest, ColumnsThatOthersWriteAreTheSame) {
  World world;
  make(world);
  fill(world);
  for (const char* name : {"alone", "shared"}) fs::create_directory(folder / name);
  write_checkpoint(folder / "alone", {"0.1", "abc", "f00d", 17, 2.5}, world, {});
  std::optional<SharedFile> part;
  ColumnVisit visit;
  visit.write = [&](const ColumnBase& column, const ColumnVisit::MakeRoom& make_room) {
    if (column.bytes() == 0) return false;
    const FileRoom room = make_room(column.bytes());
    if (!part) part.emplace(room.file);
    const std::size_t half = column.bytes() / 2;
    part->write(room.begin + half, {column.data() + half, column.bytes() - half});
    part->write(room.begin, {column.data(), half});
    return true;
  };
  visit.flush = [&] { part->flush(); };
  write_checkpoint(folder / "shared", {"0.1", "abc", "f00d", 17, 2.5}, world, {}, visit);
  World restored;
  make(restored);
  const fs::path file = checkpoints_in(folder / "shared").front();
  Checkpoint(file).restore(restored);
  for (std::size_t i = 0; i < world.columns().size(); ++i)
    if (!world.columns()[i]->declared_transient) {
      EXPECT_EQ(bytes_of(*restored.columns()[i]), bytes_of(*world.columns()[i])) << i;
    }
  const Checkpoint known = Checkpoint::verified(file),
                   alone(checkpoints_in(folder / "alone").front());
  EXPECT_EQ(known.column_bytes("cell/heat"), alone.column_bytes("cell/heat"));
  const std::vector<std::byte> all = alone.column("cell/heat");
  EXPECT_EQ(known.column("cell/heat", 8, 16),
            std::vector<std::byte>(all.begin() + 8, all.begin() + 24));
}

TEST_F(CheckpointTest, GivesEveryColumnAndResourceBack) {
  write(17);
  World expected, world;
  make(expected);
  fill(expected);
  make(world);
  const Checkpoint checkpoint(checkpoints_in(folder).front());
  EXPECT_EQ(checkpoint.info().step, 17);
  EXPECT_EQ(checkpoint.info().time, 2.5);
  EXPECT_EQ(checkpoint.info().scene_hash, "f00d");
  EXPECT_EQ(checkpoint.run("own"), std::vector<std::byte>(3, std::byte{9}));
  checkpoint.restore(world);
  EXPECT_EQ(world.table<Link>().rows, 3U);
  for (std::size_t i = 0; i < world.columns().size(); ++i)
    if (!world.columns()[i]->declared_transient) {
      EXPECT_EQ(bytes_of(*world.columns()[i]), bytes_of(*expected.columns()[i]))
          << world.columns()[i]->info.name;
    }
  EXPECT_EQ(world.resource<Clockwork>().time, 0.3);
  EXPECT_EQ(world.resource<Memory>().words, expected.resource<Memory>().words);
  EXPECT_EQ(world.resource<Memory>().last, expected.resource<Memory>().last);
  EXPECT_EQ(world.resource<Memory>().pairs, expected.resource<Memory>().pairs);
}

TEST_F(CheckpointTest, KeepsTheTwoNewest) {
  for (const int step : {5, 40, 7, 1000000}) write(step);
  const auto files = checkpoints_in(folder);
  ASSERT_THAT(files, SizeIs(2));
  EXPECT_EQ(files[0].filename(), "checkpoint-000001000000.h5");
  EXPECT_EQ(files[1].filename(), "checkpoint-000000000040.h5");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);  // nothing else is left about
}

// Any byte: of the head, of HDF5's structure, of the numbers.
TEST_F(CheckpointTest, AFlippedByteIsRecognised) {
  write(1);
  const fs::path file = checkpoints_in(folder).front();
  const std::string right = content(file);
  for (std::size_t at = 0; at < right.size(); at += 61) {
    std::string wrong = right;
    wrong[at] = static_cast<char>(wrong[at] ^ (1 << (at % 8)));
    std::ofstream(file, std::ios::binary) << wrong;
    EXPECT_THROW(Checkpoint{file}, DamagedCheckpoint) << at;
  }
  std::ofstream(file, std::ios::binary) << right;
  EXPECT_NO_THROW(Checkpoint{file});
}

// What a sum of words lets through: the same change in two of them, two that changed places.
TEST_F(CheckpointTest, ChangedPairsOfWordsAreRecognised) {
  write(1);
  const fs::path file = checkpoints_in(folder).front();
  const std::string right = content(file);
  const auto refused = [&](const std::string& wrong) {
    if (wrong == right) return true;
    std::ofstream(file, std::ios::binary) << wrong;
    try {
      const Checkpoint checkpoint(file);
      return false;
    } catch (const DamagedCheckpoint&) {
      return true;
    }
  };
  for (std::size_t a = 512; a + 8 <= right.size(); a += 328)
    for (std::size_t b = a + 8; b + 8 <= right.size(); b += 1016) {
      for (const int bit : {63, 62, 31, 0}) {
        std::string wrong = right;
        for (const std::size_t at : {a + bit / 8, b + bit / 8})
          wrong[at] = static_cast<char>(wrong[at] ^ (1 << (bit % 8)));
        EXPECT_TRUE(refused(wrong)) << "bit " << bit << " of the words at " << a << " and " << b;
      }
      std::string swapped = right, inverted = right;
      for (std::size_t i = 0; i < 8; ++i) {
        std::swap(swapped[a + i], swapped[b + i]);
        inverted[a + i] = static_cast<char>(~inverted[a + i]);
        inverted[b + i] = static_cast<char>(~inverted[b + i]);
      }
      EXPECT_TRUE(refused(swapped)) << "words at " << a << " and " << b;
      EXPECT_TRUE(refused(inverted)) << "words at " << a << " and " << b;
    }
}

TEST_F(CheckpointTest, TheFormatBeforeIsToldFromDamage) {
  std::ofstream(folder / "checkpoint-000000000001.h5", std::ios::binary)
      << "pulvis checkpoint 1\nbytes 6144\nfnv1a of words 4769b3d663aebcb0\n"
      << std::string(6600, '\0');
  EXPECT_THROW(Checkpoint{checkpoints_in(folder).front()}, OtherFormat);
}

TEST_F(CheckpointTest, AShortOrForeignFileIsRecognised) {
  write(1);
  const fs::path file = checkpoints_in(folder).front();
  const std::string right = content(file);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{100}, std::size_t{512}, right.size() / 2, right.size() - 1}) {
    std::ofstream(file, std::ios::binary) << right.substr(0, size);
    EXPECT_THROW(Checkpoint{file}, DamagedCheckpoint) << size;
  }
  std::ofstream(file, std::ios::binary) << right << "x";
  EXPECT_THROW(Checkpoint{file}, DamagedCheckpoint);
  std::ofstream(file, std::ios::binary) << std::string(5000, 'z');
  EXPECT_THROW(Checkpoint{file}, DamagedCheckpoint);
  EXPECT_THROW(Checkpoint{folder / "none"}, DamagedCheckpoint);
}

TEST_F(CheckpointTest, AWorldWithOtherColumnsIsRefused) {
  write(1);
  const Checkpoint checkpoint(checkpoints_in(folder).front());
  World more;
  make(more);
  more.add<Flux>();
  EXPECT_THROW(checkpoint.restore(more), BadState);
  World other;
  other.add_table<Cell>(std::vector<std::int32_t>{2, 1});
  other.add_table<Link>(std::size_t{0});
  for (const auto add : {&World::add<Heat>, &World::add<Ends>, &World::add<Force>}) (other.*add)();
  EXPECT_THROW(checkpoint.restore(other), BadState);  // its resources are missing
  World larger;
  larger.add_table<Cell>(std::vector<std::int32_t>{2, 2});
  larger.add<Heat>();
  EXPECT_THROW(checkpoint.restore(larger), BadState);
}

TEST_F(CheckpointTest, AFolderThatCannotBeWrittenIsAnError) {
  World world;
  make(world);
  EXPECT_THROW(write_checkpoint(folder / "none", {"0.1", "abc", "f00d", 1, 0}, world, {}),
               OutputError);
}

TEST(StateBytes, AbsurdLengthsTakeNoMemory) {
  StateWriter writer;
  std::size_t absurd = std::size_t{1} << 60;
  writer(absurd);
  std::vector<double> list;
  std::string text;
  EXPECT_THROW(StateReader(writer.bytes())(list), BadState);
  EXPECT_THROW(StateReader(writer.bytes())(text), BadState);
  double number = 0;
  EXPECT_THROW(set_state(*std::make_unique<Clockwork>(), std::vector<std::byte>(3)), BadState);
  EXPECT_THROW(set_state(*std::make_unique<Clockwork>(), std::vector<std::byte>(9)), BadState);
  const std::array two{std::byte{2}};
  bool truth = false;
  StateReader of_two{two};
  EXPECT_THROW(of_two(truth), BadState);
  StateReader reader(writer.bytes());
  reader(number);
  EXPECT_TRUE(reader.at_end());
}

}  // namespace
}  // namespace pulvis
