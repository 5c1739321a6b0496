// The task graph follows from what systems declare: edges and stages as data, then as they run.
#include "engine/task_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "engine/workers.hpp"
#include "tests/engine/test_places.hpp"

namespace pulvis::engine_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int chunks = 50;

class TaskGraphTest : public ::testing::Test {
 protected:
  TaskGraphTest() {
    world.add_table<Cell>(std::vector<std::int32_t>(chunks, 1));
    world.add_table<Bead>(std::vector<std::int32_t>(chunks, 2));
    world.add_table<Link>(3);
    world.add<Heat>();
    world.add<Flux>();
    world.add<Weight>();
    world.add<Force>();
    world.add<Ends>();
    world.emplace<Clockwork>();
  }
  template <class... Access>
  System world_system(const char* name) {
    return make_system(
        world, name, +[](Access...) {});
  }
  template <class... Access>
  System chunk_system(const char* name) {
    return make_system(
        world, name, +[](Chunk, Access...) {});
  }
  World world;
  Workers workers{4};
};

template <class... Systems>
GraphPlan plan_of(Systems... systems) {
  return derive_plan(std::vector<System>{systems...});
}

TEST_F(TaskGraphTest, WriterComesBeforeLaterReaderAndReaderBeforeLaterWriter) {
  const auto plan = plan_of(world_system<Write<Force>>("write"), world_system<Read<Force>>("read"),
                            world_system<Write<Force>>("write_again"));
  EXPECT_THAT(plan.edges, ElementsAre(std::pair(0, 1), std::pair(1, 2)));
}

TEST_F(TaskGraphTest, TwoReadersStandSideBySide) {
  const auto plan = plan_of(world_system<Write<Force>>("write"), world_system<Read<Force>>("a"),
                            world_system<Read<Force>>("b"));
  EXPECT_THAT(plan.edges, ElementsAre(std::pair(0, 1), std::pair(0, 2)));
}

TEST_F(TaskGraphTest, StagesThatShareNothingHaveNoEdge) {
  EXPECT_THAT(plan_of(world_system<Write<Force>>("a"), world_system<Write<Ends>>("b"),
                      world_system<Write<Clockwork>>("c"))
                  .edges,
              IsEmpty());
}

TEST_F(TaskGraphTest, ResourcesOrderLikeComponents) {
  const auto plan =
      plan_of(world_system<Read<Clockwork>>("a"), world_system<Write<Clockwork>>("b"));
  EXPECT_THAT(plan.edges, ElementsAre(std::pair(0, 1)));
}

TEST_F(TaskGraphTest, ChangingTheRowsOfAPlaceExcludesEveryAccessToIt) {
  const auto plan =
      plan_of(world_system<Read<Ends>>("read"), world_system<Structural<Link>>("grow"),
              world_system<Read<Force>>("read_other"), world_system<Write<Clockwork>>("away"));
  EXPECT_THAT(plan.edges, ElementsAre(std::pair(0, 1), std::pair(1, 2)));
  EXPECT_FALSE(conflict(Structural<Link>::info(), Read<Weight>::info()));
  EXPECT_FALSE(conflict(Structural<Link>::info(), Write<Clockwork>::info()));
  EXPECT_TRUE(conflict(Structural<Link>::info(), Structural<Link>::info()));
}

TEST_F(TaskGraphTest, AnEdgeThatALongerPathImpliesIsLeftOut) {
  const auto plan =
      plan_of(world_system<Write<Force>>("a"), world_system<Read<Force>, Write<Ends>>("b"),
              world_system<Read<Force>, Read<Ends>, Write<Clockwork>>("c"),
              world_system<Read<Force>, Read<Ends>, Read<Clockwork>>("d"));
  EXPECT_THAT(plan.edges, ElementsAre(std::pair(0, 1), std::pair(1, 2), std::pair(2, 3)));
}

TEST_F(TaskGraphTest, ConsecutiveChunkSystemsBecomeOneStage) {
  const auto plan =
      plan_of(chunk_system<Write<Heat>>("a"), chunk_system<Read<Heat>, Write<Flux>>("b"),
              world_system<Read<Flux>>("look"), chunk_system<Write<Weight>>("c"));
  ASSERT_EQ(plan.stages.size(), 3u);
  EXPECT_THAT(plan.stages[0].systems, ElementsAre("a", "b"));
  EXPECT_TRUE(plan.stages[0].by_chunk);
  EXPECT_FALSE(plan.stages[1].by_chunk);
  EXPECT_THAT(plan.edges, ElementsAre(std::pair(0, 1)));
}

TEST_F(TaskGraphTest, WriteWinsOverReadInAFusedStage) {
  for (const bool read_first : {true, false}) {
    const System read = chunk_system<Read<Heat>>("read"),
                 write = chunk_system<Write<Heat>>("write");
    const auto plan = read_first ? plan_of(read, write) : plan_of(write, read);
    ASSERT_EQ(plan.stages[0].accesses.size(), 1u);
    EXPECT_EQ(plan.stages[0].accesses[0].mode, AccessMode::write);
  }
}

TEST_F(TaskGraphTest, ChunkSystemThatWritesAPlaceNotDividedByChunksIsRefused) {
  EXPECT_THAT(refusal_of([&] { chunk_system<Read<Heat>, Write<Force>>("greedy"); }),
              AllOf(HasSubstr("greedy"), HasSubstr("link/force")));
  EXPECT_THAT(refusal_of([&] { chunk_system<Write<Clockwork>>("greedy"); }),
              HasSubstr("clockwork"));
  EXPECT_THAT(refusal_of([&] { chunk_system<Structural<Link>>("greedy"); }), HasSubstr("link"));
  EXPECT_NO_THROW((chunk_system<Read<Force>, Read<Clockwork>, Write<Heat>>("modest")));
}

struct Absent : Component<Link, double, 1> {
  static constexpr ComponentInfo info{"absent", "-", "a column that nobody added"};
};

TEST_F(TaskGraphTest, OptionalAccessCountsOnlyWhereItIsPresent) {
  EXPECT_THAT((world_system<Optional<Write<Absent>>>("a").accesses), IsEmpty());
  EXPECT_EQ((world_system<Optional<Write<Force>>>("a").accesses.size()), 1u);
  EXPECT_THAT(
      plan_of(world_system<Optional<Write<Absent>>>("a"), world_system<Optional<Read<Absent>>>("b"))
          .edges,
      IsEmpty());
  EXPECT_THAT(
      plan_of(world_system<Optional<Write<Force>>>("a"), world_system<Optional<Read<Force>>>("b"))
          .edges,
      ElementsAre(std::pair(0, 1)));
}

TEST_F(TaskGraphTest, MissingColumnOfASystemNamesItself) {
  EXPECT_THAT(refusal_of([&] { world_system<Read<Absent>>("a"); }), HasSubstr("absent"));
}

// ---- passes over the chunks -----------------------------------------------------------------------
// As in a step with contact: `force` gathers what the world systems found, `body` waits for nothing, `move` takes both.
TEST_F(TaskGraphTest, PassesAreThePolicyOfTheGraph) {
  const std::vector<System> systems{world_system<Write<Force>>("touch"),
                                    chunk_system<Read<Force>, Write<Flux>>("force"),
                                    chunk_system<Read<Weight>, Write<Heat>>("body"),
                                    world_system<Read<Force>, Write<Ends>>("aside"),
                                    chunk_system<Read<Heat>, Read<Flux>, Write<Weight>>("move")};
  using Stage = std::vector<std::size_t>;
  EXPECT_THAT(stages_of(systems, Passes::concurrent),
              ElementsAre(Stage{0}, Stage{2}, Stage{3}, Stage{1, 4}));
  EXPECT_THAT(stages_of(systems, Passes::fewest), ElementsAre(Stage{0}, Stage{3}, Stage{1, 2, 4}));
}

// `aside` must come after the one and before the other.
TEST_F(TaskGraphTest, APassDoesNotJoinAnotherPastWhoWaitsForIt) {
  const std::vector<System> systems{chunk_system<Write<Heat>>("first"),
                                    world_system<Read<Heat>, Write<Ends>>("aside"),
                                    chunk_system<Read<Ends>, Write<Flux>>("second")};
  for (const Passes passes : {Passes::concurrent, Passes::fewest})
    EXPECT_EQ(stages_of(systems, passes).size(), 3U);
}

// Five stages: a chunk stage of two systems between world systems, one of them off the chain.
struct CountedRun {
  std::atomic<int> calls[6] = {};
  std::atomic<int> out_of_order = 0;
};

TEST_F(TaskGraphTest, EveryStageRunsOncePerRunAndInOrder) {
  std::vector<System> systems{world_system<Write<Force>>("first"),
                              chunk_system<Read<Force>, Write<Heat>>("heat"),
                              chunk_system<Read<Heat>, Write<Flux>>("flux"),
                              world_system<Read<Flux>, Write<Ends>>("gather"),
                              world_system<Write<Clockwork>>("aside"),
                              world_system<Read<Ends>, Read<Clockwork>>("last")};
  CountedRun count;
  std::atomic<int> runs = 0;
  std::vector<std::atomic<int>> of_chunk(chunks);
  const auto expect = [&](bool right) { count.out_of_order += right ? 0 : 1; };
  systems[0].run = [&](Chunk) { expect(count.calls[5] == runs), ++count.calls[0]; };
  systems[1].run = [&](Chunk c) {
    expect(count.calls[0] == runs + 1 && of_chunk[static_cast<std::size_t>(c.index)]++ == 2 * runs);
    ++count.calls[1];
  };
  systems[2].run = [&](Chunk c) {
    expect(of_chunk[static_cast<std::size_t>(c.index)]++ == 2 * runs + 1), ++count.calls[2];
  };
  systems[3].run = [&](Chunk) { expect(count.calls[2] == (runs + 1) * chunks), ++count.calls[3]; };
  systems[4].run = [&](Chunk) { ++count.calls[4]; };
  systems[5].run = [&](Chunk) {
    expect(count.calls[3] == runs + 1 && count.calls[4] == runs + 1), ++count.calls[5];
  };
  workers.run([&] {
    TaskGraph graph(systems, chunks);
    EXPECT_THAT(graph.plan().edges,
                ElementsAre(std::pair(0, 1), std::pair(1, 2), std::pair(2, 4), std::pair(3, 4)));
    for (; runs < 200; ++runs) graph.run();
  });
  EXPECT_EQ(count.out_of_order, 0);
  for (const int world_wide : {0, 3, 4, 5}) EXPECT_EQ(count.calls[world_wide], 200) << world_wide;
  for (const int by_chunk : {1, 2}) EXPECT_EQ(count.calls[by_chunk], 200 * chunks);
}

TEST_F(TaskGraphTest, ExceptionOfASystemComesOutOfRunAndStopsWhatFollows) {
  std::vector<System> systems{chunk_system<Write<Heat>>("fails"),
                              world_system<Read<Heat>>("after")};
  bool went_on = false;
  systems[0].run = [](Chunk c) {
    if (c.index == 17) throw std::runtime_error("chunk 17 is bad");
  };
  systems[1].run = [&](Chunk) { went_on = true; };
  workers.run([&] {
    TaskGraph graph(systems, chunks);
    EXPECT_EQ(refusal_of([&] { graph.run(); }), "chunk 17 is bad");
  });
  EXPECT_FALSE(went_on);
}

// ---- small tasks beside chunks ------------------------------------------------------------------
// Chunks that were begun when the system of small tasks began, the least of many runs.
int chunks_begun_before(const std::vector<System>& systems, Workers& workers) {
  std::atomic<int> begun = 0, minimum = chunks;
  std::vector<System> counted = systems;
  for (System& system : counted) {
    const auto inner = system.run;
    if (system.by_chunk)
      system.run = [&begun, inner](Chunk c) { ++begun, inner(c); };
    else if (system.small_tasks)
      system.run = [&begun, &minimum](Chunk) { minimum = std::min<int>(minimum, begun); };
  }
  workers.run([&] {
    TaskGraph graph(counted, chunks);
    for (int i = 0; i < 100; ++i, begun = 0) {
      graph.run();
      EXPECT_EQ(begun, chunks);
    }
  });
  return minimum;
}

TEST_F(TaskGraphTest, SmallTasksBeginWhenTheChunksBesideThemHaveBeenTaken) {
  const System small = world_system<SmallTasks, Write<Force>>("small");
  ASSERT_TRUE(small.small_tasks);
  ASSERT_EQ(small.accesses.size(), 1U);
  const System beside = chunk_system<Write<Heat>>("beside");
  const System last = world_system<Read<Heat>, Read<Force>>("last");
  const GraphPlan plan = plan_of(beside, small, last);
  EXPECT_THAT(plan.stages[1].taken_before, ElementsAre(0));
  EXPECT_THAT(plan.stages[2].taken_before, IsEmpty());
  Workers one(1);
  EXPECT_EQ(chunks_begun_before({beside, small, last}, one), chunks);
  // Each of the three other threads may have taken a chunk that it has not begun yet.
  EXPECT_GE(chunks_begun_before({beside, small, last}, workers), chunks - 3);
}

// `hurried` would come while a helper still has a chunk of what it reads.
TEST_F(TaskGraphTest, SmallTasksDoNotHelpWhereSomebodyWaitsForTheChunksAlone) {
  const GraphPlan plan =
      plan_of(chunk_system<Write<Heat>>("beside"), world_system<SmallTasks, Write<Force>>("small"),
              world_system<Read<Heat>, Write<Ends>>("hurried"),
              world_system<Read<Ends>, Read<Force>>("last"));
  EXPECT_THAT(plan.stages[1].taken_before, IsEmpty());
}

// Nor where the chunks themselves wait for something: they cannot be taken yet.
TEST_F(TaskGraphTest, SmallTasksDoNotHelpWithChunksThatWait) {
  const GraphPlan plan =
      plan_of(world_system<Write<Ends>>("first"), chunk_system<Read<Ends>, Write<Heat>>("beside"),
              world_system<SmallTasks, Write<Force>>("small"),
              world_system<Read<Heat>, Read<Force>>("last"));
  EXPECT_THAT(plan.stages[2].taken_before, IsEmpty());
}

// ---- transient components -----------------------------------------------------------------------
void leave(Chunk c, Write<Passing> passing) {
  passing.chunk(c)(Row<Cell>(0)) = Lane(c.index + 1.0);
}
void take(Chunk c, Read<Passing> passing, Write<Heat> heat) {
  heat.chunk(c)(Row<Cell>(0), 0) = passing.chunk(c)(Row<Cell>(0));
}
void look(Read<Passing>) {}

// Timed in every 61st run only, told of all of them. A system that sleeps for a millisecond takes no less.
TEST_F(TaskGraphTest, TellsWhatEachSystemTook) {
  System sleeps = world_system<Write<Force>>("sleeps"), rests = world_system<Write<Ends>>("rests");
  sleeps.run = [](Chunk) { std::this_thread::sleep_for(std::chrono::milliseconds(1)); };
  workers.run([&] {
    TaskGraph graph({sleeps, rests}, chunks);
    EXPECT_EQ(graph.costs()[0].seconds, 0);
    for (int i = 0; i < 133; ++i) graph.run();  // three are timed
    const auto costs = graph.costs();
    ASSERT_EQ(costs.size(), 2U);
    EXPECT_EQ(costs[0].system, "sleeps");
    EXPECT_GE(costs[0].seconds, 0.133);  // sleep_for takes no less
    EXPECT_EQ(costs[1].system, "rests");
    EXPECT_GE(costs[1].seconds, 0);
  });
}

// As the evaluation of the stable time step does.
TEST_F(TaskGraphTest, TellsWhatIsDoneEveryEighthRun) {
  System sleeps = world_system<Write<Force>>("sleeps");
  int run = 0;
  sleeps.run = [&](Chunk) {
    if (run++ % 8 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  workers.run([&] {
    TaskGraph graph({sleeps}, chunks);
    while (run < 8 * 61) graph.run();  // eight are timed
    EXPECT_GE(graph.costs()[0].seconds, 0.061);
    EXPECT_LT(graph.costs()[0].seconds, 0.3);  // 0.488 if it were every run
  });
}

TEST(Transients, AreDroppedOnlyWhereOnePassTouchesThem) {
  World world;
  world.add_table<Cell>({1, 1});
  world.add<Passing>();
  world.add<Heat>();
  const System left = make_system(world, "leave", leave), taken = make_system(world, "take", take);
  const System looked = make_system(world, "look", look);
  EXPECT_THAT(droppable_components({left, taken}), ElementsAre(type_key<Passing>()));
  EXPECT_THAT(droppable_components({taken, left}), ElementsAre());          // read first
  EXPECT_THAT(droppable_components({left, looked, taken}), ElementsAre());  // two passes
  EXPECT_THAT(droppable_components({left, taken, looked}), ElementsAre());  // read later
}

TEST(Transients, ReachTheNextSystemOfThePassAndLeaveTheColumnAlone) {
  World world;
  world.add_table<Cell>(std::vector<std::int32_t>(chunks, 1));
  world.add<Passing>();
  world.add<Heat>();
  const std::vector<System> systems{make_system(world, "leave", leave),
                                    make_system(world, "take", take)};
  Workers workers(3);
  const auto heat = [&](int chunk) {
    return Read<Heat>(world).chunk(Chunk{chunk})(Row<Cell>(0), 0)[5];
  };
  const auto kept = [&](int chunk) {
    return Read<Passing>(world).chunk(Chunk{chunk})(Row<Cell>(0))[5];
  };
  workers.run([&] {
    world.allocate_transient(droppable_components(systems), 3);
    TaskGraph dropping(systems, chunks, Passes::concurrent, Transients::dropped);
    for (int i = 0; i < 20; ++i) dropping.run();
  });
  for (int c = 0; c < chunks; ++c) {
    EXPECT_EQ(heat(c), c + 1.0);
    EXPECT_EQ(kept(c), 0);
  }
  workers.run([&] { TaskGraph(systems, chunks).run(); });
  for (int c = 0; c < chunks; ++c) EXPECT_EQ(kept(c), c + 1.0);
}

// ---- scratch ------------------------------------------------------------------------------------
void work_in_scratch(Chunk chunk, Write<Workspace> workspace, Write<Heat> heat) {
  const auto own = workspace.chunk(chunk);
  const Row<Cell> first(0);
  own(first, 1) = Lane(chunk.index + 1.0);
  heat.chunk(chunk)(first, 0) = own(first, 1);
}

TEST(Scratch, IsOfEveryWorkerAndNoColumnOfTheWorld) {
  World world;
  world.add_table<Cell>(std::vector<std::int32_t>(chunks, 1));
  world.add<Workspace>();
  world.add<Heat>();
  EXPECT_EQ(world.columns().size(), 1u);
  EXPECT_TRUE(world.has<Workspace>());
  EXPECT_EQ(world.column<Workspace>().bytes(), 0u);
  const System works = make_system(world, "works", work_in_scratch);
  works.run(Chunk{3});  // by itself: one worker
  EXPECT_EQ(Read<Heat>(world).chunk(Chunk{3})(Row<Cell>(0), 0)[5], 4);
  Workers workers(3);
  workers.run([&] {
    world.allocate_transient({}, 3);
    TaskGraph graph({works}, chunks);
    for (int i = 0; i < 20; ++i) graph.run();
  });
  for (int c = 0; c < chunks; ++c)
    EXPECT_EQ(Read<Heat>(world).chunk(Chunk{c})(Row<Cell>(0), 0)[5], c + 1.0);
}

// ---- looking ahead ------------------------------------------------------------------------------
TEST_F(TaskGraphTest, BusySystemLooksAheadToWhatOthersOfItsPassTouch) {
  System busy = make_system(
      world, "busy", +[](BusyChunk, Read<Weight>) {});
  ASSERT_TRUE(busy.busy);
  std::vector<int> lines(chunks);
  busy.run = [&](Chunk c) {
    if (c.ahead == nullptr) return;
    for (int more = -1; more != 0;)
      lines[static_cast<std::size_t>(c.index)] += more = c.ahead->fetch();
  };
  const auto bytes = [&](TypeKey key) {
    return static_cast<int>(world.find(key)->of_chunk(0).size());
  };
  const auto lines_of = [&](TypeKey key) { return (bytes(key) + 63) / 64; };
  const std::vector<System> systems{chunk_system<Read<Heat>>("before"), busy,
                                    chunk_system<Read<Heat>, Write<Flux>>("after"),
                                    world_system<Read<Force>>("in_no_pass")};
  workers.run(
      [&] { TaskGraph(systems, chunks, Passes::concurrent, Transients::kept, &world).run(); });
  const int of_next = lines_of(type_key<Heat>()) + lines_of(type_key<Weight>());
  const int of_this = lines_of(type_key<Flux>());
  EXPECT_GT(of_next, 0);
  EXPECT_GT(of_this, 0);
  EXPECT_EQ(lines.front(), of_this + of_next);
  EXPECT_EQ(lines.back(), of_this);  // no chunk comes after it

  std::ranges::fill(lines, 0);
  workers.run([&] { TaskGraph(systems, chunks).run(); });
  EXPECT_THAT(lines, ::testing::Each(0));
}

TEST_F(TaskGraphTest, GraphStillRunsAfterBeingMoved) {
  std::atomic<int> calls = 0;
  System system = world_system<Write<Force>>("count");
  system.run = [&](Chunk) { ++calls; };
  workers.run([&] {
    TaskGraph graph({system}, chunks);
    TaskGraph moved(std::move(graph));
    moved.run();
  });
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace pulvis::engine_test
