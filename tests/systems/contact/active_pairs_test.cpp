// Active pairs: every active candidate is looked at once, in the same two whatever the threads.
#include "systems/contact/active_pairs.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "engine/workers.hpp"

namespace pulvis {
namespace {

// Notes what it is given.
struct Noting {
  using Sums = LaneSums;
  int every;                // of so many is one active
  std::vector<int>& times;  // [rows]
  std::vector<std::int32_t>&
      two;  // [rows]: with which other it came; itself where one is left over

  bool active(Row<Contact> row) const { return (row.value * 7919 + row.value / 5) % every == 0; }
  void fetch(Row<Contact>) const {}
  void fetch_other(Row<Contact>) const {}
  void operator()(const TwoCandidates<Contact>& pair, LaneSums& sums) const {
    for (int i = 0; i < count_of(pair); ++i) {
      const int row = entry(pair, i).value;
      entry(times, row) += 1;
      entry(two, row) = entry(pair, 1 - i).value;
      sums.block.touching += 1;
      sums.energy += 1.0 / (row + 1);
    }
  }
  void operator()(const TwoCandidates<Contact>& a, const TwoCandidates<Contact>& b,
                  LaneSums& sums) const {
    (*this)(a, sums);
    (*this)(b, sums);
  }
};

struct Walked {
  std::vector<int> times;
  std::vector<std::int32_t> two;
  ContactSums<Contact> sums;
};

Walked walk(int rows, int every, int threads) {
  Walked walked{std::vector<int>(static_cast<std::size_t>(rows)),
                std::vector<std::int32_t>(static_cast<std::size_t>(rows), -1),
                {}};
  RowBlocks<Contact> blocks;
  blocks.divide({0, 0, 0, 0, 0, 0, 0, 0, rows});  // of one chunk
  Workers workers(threads);
  workers.run([&] {
    for_active_pairs(blocks, walked.sums.blocks, Noting{every, walked.times, walked.two});
  });
  return walked;
}

constexpr int sizes[] = {0, 1, 2, 127, 128, 129, 1000, 20000};

TEST(ActivePairs, LookAtEveryActiveCandidateOnce) {
  for (const int rows : sizes)
    for (const int every : {1, 2, 7}) {
      const Walked walked = walk(rows, every, 2);
      int active = 0, counted = 0;
      for (int r = 0; r < rows; ++r) {
        const bool is = Noting{every, const_cast<std::vector<int>&>(walked.times),
                               const_cast<std::vector<std::int32_t>&>(walked.two)}
                            .active(Row<Contact>(r));
        ASSERT_EQ(entry(walked.times, r), is ? 1 : 0) << r << " of " << rows;
        active += is ? 1 : 0;
      }
      for (const BlockSums& block : walked.sums.blocks) counted += block.touching;
      EXPECT_EQ(counted, active);
      EXPECT_EQ(walked.sums.blocks.size(), static_cast<std::size_t>((rows + 127) / 128));
    }
}

TEST(ActivePairs, AreTheSameForAnyNumberOfThreads) {
  for (const int rows : sizes) {
    const Walked one = walk(rows, 3, 1), four = walk(rows, 3, 4);
    EXPECT_EQ(one.two, four.two);
    ASSERT_EQ(one.sums.blocks.size(), four.sums.blocks.size());
    for (std::size_t b = 0; b < one.sums.blocks.size(); ++b)
      EXPECT_EQ(one.sums.blocks[b].energy, four.sums.blocks[b].energy);
  }
}

// Two are of one block, so that what a block books is its own.
TEST(ActivePairs, StayWithinABlock) {
  const Walked walked = walk(1000, 2, 2);
  for (int r = 0; r < 1000; ++r)
    if (entry(walked.times, r) > 0) {
      EXPECT_EQ(entry(walked.two, r) / RowBlocks<Contact>::most, r / RowBlocks<Contact>::most);
    }
}

// What a chunk adds up does not depend on the rows of chunks before it.
TEST(ActivePairs, BeginABlockWithEveryChunk) {
  RowBlocks<Contact> blocks;
  std::vector<std::int32_t> begin(3 * lane_count + 1);
  for (int slot = 0; slot < 3 * lane_count; ++slot)
    entry(begin, slot + 1) = entry(begin, slot) + (slot < lane_count ? 20 : slot < 2 * lane_count ? 0 : 1);
  blocks.divide(begin);
  EXPECT_EQ(blocks.begin, (std::vector<std::int32_t>{0, 128, 160, 168}));
}

}  // namespace
}  // namespace pulvis
