// The world: what is missing names itself, rows keep their values, lanes lie as declared.
#include "engine/world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <random>

#include "tests/engine/test_places.hpp"

namespace pulvis::engine_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(World, MissingTableNamesItself) {
  World world;
  EXPECT_THAT(refusal_of([&] { world.table<Link>(); }), HasSubstr("link"));
  EXPECT_THAT(refusal_of([&] { world.add<Force>(); }), HasSubstr("link"));
  EXPECT_FALSE(world.has_table<Link>());
}

TEST(World, MissingColumnNamesItselfAndItsPlace) {
  World world;
  world.add_table<Link>(3);
  EXPECT_FALSE(world.has<Force>());
  EXPECT_THAT(refusal_of([&] { world.column<Force>(); }),
              AllOf(HasSubstr("force"), HasSubstr("link")));
  EXPECT_THAT(refusal_of([&] { Read<Force>{world}; }), HasSubstr("force"));
}

TEST(World, MissingResourceNamesItself) {
  World world;
  EXPECT_FALSE(world.has<Clockwork>());
  EXPECT_THAT(refusal_of([&] { world.resource<Clockwork>(); }), HasSubstr("clockwork"));
}

TEST(World, NewColumnIsZeroAndAligned) {
  World world;
  world.add_table<Cell>({5, 2});
  world.add<Heat>();
  const Column<Heat>& heat = world.column<Heat>();
  ASSERT_EQ(heat.bytes(), 7u * 2 * lane_count * sizeof(double));
  for (std::size_t i = 0; i < 7 * 2 * lane_count; ++i) ASSERT_EQ(heat.values()[i], 0);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(heat.data()) % 64, 0u);
}

TEST(World, AddingAColumnAgainKeepsItsValues) {
  World world;
  world.add_table<Link>(1);
  world.add<Force>();
  world.column<Force>().values()[0] = 3;
  world.add<Force>();
  EXPECT_EQ(world.column<Force>().values()[0], 3);
  EXPECT_EQ(world.columns().size(), 1u);
}

// Every row of `sources` against what rows held before: ten more than their number.
void expect_rebuilt(World& world, const std::vector<std::int32_t>& sources) {
  for (std::size_t r = 0; r < world.table<Link>().rows; ++r) {
    world.column<Force>().values()[r] = 10 + static_cast<double>(r);
    for (std::size_t k = 0; k < 2; ++k)
      world.column<Ends>().values()[2 * r + k] = static_cast<std::int32_t>(7 * r + k);
  }
  world.rebuild<Link>(sources);
  ASSERT_EQ(world.table<Link>().rows, sources.size());
  ASSERT_EQ(world.column<Force>().bytes(), sources.size() * sizeof(double));
  for (std::size_t r = 0; r < sources.size(); ++r) {
    const bool is_new = sources[r] < 0;
    ASSERT_EQ(world.column<Force>().values()[r], is_new ? 0 : 10 + sources[r]) << r;
    for (std::size_t k = 0; k < 2; ++k)
      ASSERT_EQ(world.column<Ends>().values()[2 * r + k],
                is_new ? 0 : 7 * sources[r] + static_cast<std::int32_t>(k))
          << r;
  }
}

TEST(World, RebuildCarriesRowsBySourceAndZerosNewOnes) {
  World world;
  world.add_table<Link>(5);
  world.add<Force>();
  world.add<Ends>();
  expect_rebuilt(world, {-1, 0, 1, 4, -1, -1, -1});   // to the back and to the front
  expect_rebuilt(world, {-1, -1, 0, 1, 2, 3, 4, 6});  // to the back, and more
  expect_rebuilt(world, {3, 4, 7});
  expect_rebuilt(world, {0, 1, 2});
}

// Up and down through sizes that come from the heap, or in pages of their own.
TEST(World, RebuildCarriesManyRows) {
  World world;
  world.add_table<Link>(std::size_t{0});
  world.add<Force>();
  world.add<Ends>();
  std::minstd_rand random(7);
  for (const std::size_t rows : {100, 900'000, 1'000'000, 300'000, 310'000, 60'000, 700'000, 10}) {
    const std::size_t before = world.table<Link>().rows;
    std::vector<std::int32_t> sources;
    for (std::size_t r = 0, source = 0; r < rows; ++r) {
      source += random() % 3;
      sources.push_back(random() % 2 == 0 && source < before ? static_cast<std::int32_t>(source)
                                                             : -1);
      source += 1;
    }
    expect_rebuilt(world, sources);
  }
}

TEST(World, RebuildRefusesRowsThatChangePlaces) {
  World world;
  world.add_table<Link>(3);
  EXPECT_THROW(world.rebuild<Link>({2, -1, 0}), std::logic_error);
  EXPECT_THROW(world.rebuild<Link>({0, 0, 1}), std::logic_error);
}

TEST(World, RebuildFromNothingAndToNothing) {
  World world;
  world.add_table<Link>(std::size_t{0});
  world.add<Force>();
  world.rebuild<Link>({-1, -1});
  EXPECT_EQ(world.column<Force>().bytes(), 2 * sizeof(double));
  world.rebuild<Link>({});
  EXPECT_EQ(world.column<Force>().bytes(), 0u);
  EXPECT_EQ(world.table<Link>().rows, 0u);
}

TEST(World, LanedRowsLieRowThenComponentThenLane) {
  World world;
  world.add_table<Cell>({1, 2});
  world.add<Heat>();
  Column<Heat>& heat = world.column<Heat>();
  for (int i = 0; i < 3 * 2; ++i)
    for (int lane = 0; lane < lane_count; ++lane) heat.lanes()[i][lane] = lane_count * i + lane;
  for (int i = 0; i < 3 * 2 * lane_count; ++i) ASSERT_EQ(heat.values()[i], i);
  const auto second = Read<Heat>(world).chunk(Chunk{1});
  EXPECT_EQ(second(Row<Cell>(0), 0)[0], 2 * lane_count);  // row 1 of the table, its first component
  EXPECT_EQ(second(Row<Cell>(1), 1)[3], lane_count * 5 + 3);
}

TEST(World, ChunksOfAPlainTableStartWhereTheLastOnesEnd) {
  World world;
  world.add_table<Bead>({2, 0, 3});
  world.add<Weight>();
  for (int r = 0; r < 5; ++r) world.column<Weight>().values()[r] = r;
  EXPECT_EQ(Read<Weight>(world).chunk(Chunk{0})(Row<Bead>(1)), 1);
  EXPECT_EQ(Read<Weight>(world).chunk(Chunk{2})(Row<Bead>(0)), 2);
  EXPECT_EQ(world.chunks(), 3);
}

TEST(World, TableDividedByAnotherNumberOfChunksIsRefused) {
  World world;
  world.add_table<Cell>({1, 2});
  EXPECT_THAT(refusal_of([&] { world.add_table<Bead>({1, 2, 3}); }), HasSubstr("bead"));
  world.add_table<Link>(7);  // not divided at all: welcome
}

TEST(World, TableAddedTwiceIsRefused) {
  World world;
  world.add_table<Link>(1);
  EXPECT_THAT(refusal_of([&] { world.add_table<Link>(2); }), HasSubstr("link"));
}

// ---- sparse: of a rank's world, which holds some chunks of many ----------------------------------------
// Bytes of a column that take memory: from its first page to its last.
std::size_t resident_bytes(const ColumnBase& column) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  std::vector<unsigned char> pages((column.bytes() + page - 1) / page);
  EXPECT_EQ(::mincore(const_cast<std::byte*>(column.data()), column.bytes(), pages.data()), 0);
  return page * static_cast<std::size_t>(std::ranges::count_if(
                    pages, [](unsigned char state) { return (state & 1) != 0; }));
}

class SparseWorld : public ::testing::Test {
 protected:
  // 64 chunks of 1 MB each in a column of weights, which is 8 bytes a row.
  static constexpr std::int32_t rows = 1 << 17;
  static constexpr int chunks = 64;
  static constexpr std::size_t chunk_bytes = std::size_t{rows} * 8;
  void SetUp() override { world.add_table<Bead>(std::vector<std::int32_t>(chunks, rows)); }
  static std::vector<bool> some(int first, int end) {
    std::vector<bool> own(chunks);
    for (int c = first; c < end; ++c) own[static_cast<std::size_t>(c)] = true;
    return own;
  }
  void write(int first, int end) {
    const std::int64_t begin = std::int64_t{rows} * first;
    std::fill_n(world.column<Weight>().values() + begin, std::int64_t{rows} * (end - first), 7.0);
  }
  World world{Buffer::Kind::sparse};
};

TEST_F(SparseWorld, TakesMemoryForWhatIsWrittenAlone) {
  world.hold(some(8, 16));
  world.add<Weight>();
  EXPECT_EQ(resident_bytes(world.column<Weight>()), 0u);
  write(8, 16);
  const std::size_t taken = resident_bytes(world.column<Weight>());
  EXPECT_GE(taken, 8 * chunk_bytes);
  EXPECT_LE(taken, 12 * chunk_bytes);  // and at both ends what is left of a huge page, 2 MB
  EXPECT_EQ(world.column<Weight>().values()[0], 0);
}

TEST_F(SparseWorld, GivesBackWhatIsDropped) {
  world.hold(some(8, 16));
  world.add<Weight>();
  write(8, 16);
  world.hold(some(32, 40));  // as after a migration
  write(32, 40);
  world.column<Weight>().drop(std::size_t{rows} * 8, std::size_t{rows} * 8);
  const std::size_t taken = resident_bytes(world.column<Weight>());
  EXPECT_GE(taken, 8 * chunk_bytes);
  EXPECT_LE(taken, 16 * chunk_bytes);
  EXPECT_EQ(world.column<Weight>().values()[std::int64_t{rows} * 8], 0);
  EXPECT_EQ(world.column<Weight>().values()[std::int64_t{rows} * 32], 7);
}

TEST_F(SparseWorld, ADroppedColumnTakesNothingAndGetsItsRowsAgain) {
  world.add<Weight>();
  write(0, chunks);
  world.drop_column(world.column<Weight>());
  EXPECT_EQ(resident_bytes(world.column<Weight>()), 0u);
  EXPECT_EQ(world.column<Weight>().values()[5], 0);
  EXPECT_EQ(world.room_for(world.column<Weight>(), std::size_t{rows} * chunks).size(),
            chunks * chunk_bytes);
  EXPECT_THROW(world.room_for(world.column<Weight>(), 3), BadState);
}

TEST(World, RoomForRowsMakesAsManyOfTheirKind) {
  World world;
  world.add_table<Link>(2);
  world.add<Force>();
  EXPECT_EQ(world.room_for(world.column<Force>(), 5).size(), 5 * world.column<Force>().row_bytes);
  EXPECT_EQ(world.table<Link>().rows, 5u);
  world.drop_column(world.column<Force>());
  EXPECT_EQ(world.column<Force>().bytes(), 0u);
}

}  // namespace
}  // namespace pulvis::engine_test
