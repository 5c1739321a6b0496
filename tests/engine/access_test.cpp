// Misuse that must not compile, as far as a type can be asked; and what an access tells the graph.
#include "engine/access.hpp"

#include <gtest/gtest.h>

#include <concepts>
#include <type_traits>
#include <utility>

#include "engine/system.hpp"
#include "tests/engine/test_places.hpp"

namespace pulvis::engine_test {
namespace {

template <class Handle, class Entity>
using RowValue = decltype(std::declval<Handle>()(Row<Entity>{}));
template <class Handle>
using ChunkOf = decltype(std::declval<Handle>().chunk(Chunk{}));

// Rows: nothing is written through Read, of no kind.
static_assert(!std::is_assignable_v<RowValue<Read<Weight>, Bead>, double>);
static_assert(std::is_assignable_v<RowValue<Write<Weight>, Bead>, double>);
static_assert(!std::is_assignable_v<RowValue<Read<Ends>, Link>, int>);
static_assert(!std::is_assignable_v<RowValue<ChunkOf<Read<Weight>>, Bead>, double>);
static_assert(std::is_assignable_v<RowValue<ChunkOf<Write<Weight>>, Bead>, double>);
static_assert(!std::is_assignable_v<RowValue<ChunkOf<Read<Heat>>, Cell>, Lane>);
static_assert(std::is_assignable_v<RowValue<ChunkOf<Write<Heat>>, Cell>, Lane>);

// Whole columns and resources likewise.
static_assert(!std::is_assignable_v<decltype(std::declval<Read<Heat>>().values()[0]), double>);
static_assert(std::is_assignable_v<decltype(std::declval<Write<Heat>>().values()[0]), double>);
static_assert(!std::is_assignable_v<decltype((std::declval<Read<Clockwork>>()->time)), double>);
static_assert(std::is_assignable_v<decltype((std::declval<Write<Clockwork>>()->time)), double>);
static_assert(!std::is_assignable_v<decltype(*std::declval<Read<Clockwork>>()), Clockwork>);

// An Optional gives no more than what it wraps.
static_assert(!std::is_assignable_v<
              RowValue<decltype(*std::declval<Optional<Read<Weight>>>()), Bead>, double>);
static_assert(std::is_assignable_v<
              RowValue<decltype(*std::declval<Optional<Write<Weight>>>()), Bead>, double>);
static_assert(!std::convertible_to<Optional<Read<Weight>>, bool>);  // only where a condition asks

// The right to read never becomes the right to write.
static_assert(!std::constructible_from<Write<Weight>, Read<Weight>>);
static_assert(!std::constructible_from<Write<Clockwork>, Read<Clockwork>>);
static_assert(!std::convertible_to<World&, Write<Weight>>);

// Rows of different places do not mix, and a bare number is no row.
static_assert(!std::convertible_to<Row<Cell>, Row<Bead>>);
static_assert(!std::constructible_from<Row<Bead>, Row<Cell>>);
static_assert(!std::is_assignable_v<Row<Bead>&, Row<Cell>>);
static_assert(!std::equality_comparable_with<Row<Bead>, Row<Cell>>);
static_assert(!std::convertible_to<int, Row<Bead>>);
static_assert(!std::convertible_to<Row<Bead>, int>);
static_assert(!std::invocable<Read<Weight>, Row<Link>>);
static_assert(!std::invocable<ChunkOf<Read<Heat>>, Row<Bead>>);
static_assert(!std::invocable<Read<Weight>, int>);
static_assert(std::invocable<Read<Weight>, Row<Bead>>);

// A place is neither a component nor a resource, so nothing reads it; only components have rows.
template <class T>
concept Readable = requires {
  typename Read<T>;
}
&&(IsComponent<T> || IsResource<T>);
static_assert(Readable<Weight> && Readable<Clockwork>);
static_assert(!Readable<Cell>);
static_assert(!std::invocable<Structural<Link>, Row<Link>>);

TEST(Access, TellsWhatItTouchesAndHow) {
  const AccessInfo read = Read<Heat>::info(), write = Write<Ends>::info();
  EXPECT_EQ(read.name, "cell/heat");
  EXPECT_EQ(read.mode, AccessMode::read);
  EXPECT_EQ(read.key, type_key<Heat>());
  EXPECT_EQ(read.entity, type_key<Cell>());
  EXPECT_TRUE(read.chunked);
  EXPECT_EQ(write.mode, AccessMode::write);
  EXPECT_FALSE(write.chunked);
  EXPECT_EQ(Read<Clockwork>::info().name, "clockwork");
  EXPECT_EQ(Read<Clockwork>::info().entity, nullptr);
  EXPECT_EQ(Structural<Link>::info().mode, AccessMode::structural);
  EXPECT_EQ(Structural<Link>::info().entity, type_key<Link>());
}

TEST(Access, WritesAreSeenByReads) {
  World world;
  world.add_table<Bead>({2, 1});
  world.add<Weight>();
  const Write<Weight> write(world);
  const Read<Weight> read(world);
  write.chunk(Chunk{1})(Row<Bead>(0)) = 7;
  EXPECT_EQ(read(Row<Bead>(2)), 7);
  EXPECT_EQ(read.values()[2], 7);
  EXPECT_EQ(read.rows(), 3);
}

TEST(Access, HandlesFollowTheirColumnThroughARebuild) {
  World world;
  world.add_table<Link>(1);
  world.add<Force>();
  const Write<Force> force(world);
  force(Row<Link>(0)) = 5;
  Structural<Link>(world).rebuild({-1, 0});
  EXPECT_EQ(force.rows(), 2);
  EXPECT_EQ(force(Row<Link>(1)), 5);
}

TEST(Access, OptionalIsEmptyWhereTheWorldLacksIt) {
  World world;
  world.add_table<Link>(1);
  world.add<Force>();
  EXPECT_TRUE(static_cast<bool>(Optional<Read<Force>>(world)));
  EXPECT_FALSE(static_cast<bool>(Optional<Write<Ends>>(world)));
  EXPECT_FALSE(static_cast<bool>(Optional<Read<Clockwork>>(world)));
}

}  // namespace
}  // namespace pulvis::engine_test
