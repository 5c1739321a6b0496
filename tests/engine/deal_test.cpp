// Pieces of work reach every thread once, its own first.
#include "engine/deal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "engine/workers.hpp"

namespace pulvis::engine_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

std::vector<int> taken_by_one_thread(Deal& deal) {
  std::vector<int> taken;
  Workers(1).run([&] {
    while (const auto piece = deal.take()) taken.push_back(*piece);
  });
  return taken;
}

TEST(Deal, AThreadTakesItsOwnInOrderAndThenTheLastOfOthers) {
  Deal alone(4, 1), first_of_two(7, 2), one_of_many(2, 5);
  EXPECT_THAT(taken_by_one_thread(alone), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(taken_by_one_thread(first_of_two), ElementsAre(0, 1, 2, 6, 5, 4, 3));
  EXPECT_THAT(taken_by_one_thread(one_of_many), ::testing::UnorderedElementsAre(0, 1));
}

TEST(Deal, IsThereAgainAfterARestart) {
  Deal deal(7, 2);
  const auto taken = taken_by_one_thread(deal);
  EXPECT_THAT(taken_by_one_thread(deal), ElementsAre());
  deal.restart();
  EXPECT_EQ(taken_by_one_thread(deal), taken);
  Deal nothing(0, 3);
  EXPECT_THAT(taken_by_one_thread(nothing), ElementsAre());
}

TEST(Deal, EveryPieceIsTakenOnceByAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3, 8})
    for (const int pieces : {1, 2, 7, 1000}) {
      std::vector<std::atomic<int>> times(static_cast<std::size_t>(pieces));
      Workers(threads).run([&] {
        Deal deal(pieces, threads);
        for (int round = 0; round < 20; ++round) {
          for_pieces(deal, [&](int piece) { ++times[static_cast<std::size_t>(piece)]; });
          deal.restart();
        }
      });
      EXPECT_THAT(std::vector<int>(times.begin(), times.end()), Each(20))
          << threads << " threads, " << pieces << " pieces";
    }
}

}  // namespace
}  // namespace pulvis::engine_test
