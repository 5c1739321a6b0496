#include "engine/result_cache.hpp"

#include <gmock/gmock.h>

#include <string>
#include <thread>
#include <vector>

namespace pulvis {
namespace {

using ::testing::ElementsAre;

struct Asked {
  ResultCache<int, std::string> cache{6};
  std::vector<int> made;

  std::string of(int order) {
    const auto make = [&](int i) {
      made.push_back(i);
      return std::string(static_cast<std::size_t>(i), 'x');
    };
    return cache.get(order, make, [](const std::string& text) { return text.size(); });
  }
};

TEST(ResultCache, MakesNothingTwice) {
  Asked asked;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(asked.of(2), "xx");
    EXPECT_EQ(asked.of(3), "xxx");
  }
  EXPECT_THAT(asked.made, ElementsAre(2, 3));
}

TEST(ResultCache, TheOldestGoFirstWhereThereIsNoRoom) {
  Asked asked;
  for (const int order : {1, 2, 3, 4, 3, 2}) asked.of(order);
  EXPECT_THAT(asked.made, ElementsAre(1, 2, 3, 4, 3, 2)) << "four leave no room for another three";
  EXPECT_EQ(asked.of(7), "xxxxxxx") << "larger than all room, and not kept";
  asked.of(7);
  EXPECT_EQ(asked.made.size(), 8U);
  asked.of(2);
  EXPECT_EQ(asked.made.size(), 8U) << "others stay";
}

TEST(ResultCache, SharesBetweenThreads) {
  ResultCache<int, int> cache(100);
  std::vector<std::thread> threads;
  std::vector<int> sums(4);
  for (std::size_t t = 0; t < sums.size(); ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 1000; ++i)
        sums[t] += cache.get(
            i % 50, [](int order) { return 2 * order; }, [](int) { return 1; });
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(sums, ::testing::Each(20 * 2 * 49 * 50 / 2));
}

}  // namespace
}  // namespace pulvis
