// Accesses that go together: what a bundle tells the graph, and a system that is one.
#include "engine/bundle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/system.hpp"
#include "tests/engine/test_places.hpp"

namespace pulvis::engine_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class BundleTest : public ::testing::Test {
 protected:
  BundleTest() {
    world.add_table<Cell>(std::vector<std::int32_t>(8, 1));
    world.add_table<Bead>(std::vector<std::int32_t>(8, 2));
    world.add_table<Link>(3);
    world.add<Heat>();
    world.add<Flux>();
    world.add<Weight>();
    world.add<Force>();
    world.emplace<Clockwork>();
  }
  World world;
};

struct NotThere : Component<Link, double, 1> {
  static constexpr ComponentInfo info{"absent", "-", "a column that nobody added"};
};

template <template <class> class Mode>
struct Warmth {
  Mode<Heat> heat;
  Mode<Flux> flux;
};
struct Bundled {
  Warmth<Read> warmth;
  Optional<Read<Weight>> weight;
  Optional<Read<NotThere>> absent;
};
struct warm {
  Bundled bundled;
  Optional<Warmth<Write>> twice;
  Read<Clockwork> clockwork;
  void operator()(Chunk chunk) const {
    twice->heat.chunk(chunk)(Row<Cell>(0), 1) = bundled.weight->chunk(chunk)(Row<Bead>(1));
  }
};
struct half_there {
  struct Half {
    Read<Force> force;
    Read<NotThere> absent;
  };
  Optional<Half> half;
  void operator()() const {}
};
struct not_there {
  struct None {
    Read<NotThere> absent;
    Read<Force> force;
  };
  Optional<None> none;
  void operator()(SmallTasks) const {}
};

TEST_F(BundleTest, ABundleDeclaresAllItsMembersInOrder) {
  const System system = make_system<warm>(world, "warm");
  EXPECT_TRUE(system.by_chunk);
  std::vector<std::string> names;
  for (const AccessInfo& access : system.accesses)
    names.push_back((access.mode == AccessMode::write ? "write " : "read ") + access.name);
  EXPECT_THAT(names, ElementsAre("read cell/heat", "read cell/flux", "read bead/weight",
                                 "write cell/heat", "write cell/flux", "read clockwork"));
  world.column<Weight>().values()[2 * 7 + 1] = 11;
  system.run(Chunk{7});
  EXPECT_EQ(Read<Heat>(world).chunk(Chunk{7})(Row<Cell>(0), 1)[0], 11);
}

TEST_F(BundleTest, ABundleIsThereWhereItsFirstMemberIsAndThenWhole) {
  EXPECT_THAT(refusal_of([&] { make_system<half_there>(world, "half"); }), HasSubstr("absent"));
  const System system = make_system<not_there>(world, "none");
  EXPECT_THAT(system.accesses, IsEmpty());
  EXPECT_TRUE(system.small_tasks);
  EXPECT_FALSE(system.by_chunk);
}

void warm_function(Chunk, Bundled, Write<Flux>) {}

TEST_F(BundleTest, AFunctionTakesBundlesToo) {
  EXPECT_EQ(make_system(world, "warm", warm_function).accesses.size(), 4U);
}

static_assert(!std::is_aggregate_v<Read<Heat>> && !IsBundle<Optional<Read<Heat>>>);

}  // namespace
}  // namespace pulvis::engine_test
