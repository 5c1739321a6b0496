#include "scenes/results/fragment_sizes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace pulvis {
namespace {

using ::testing::ElementsAre;

TEST(FragmentSizes, AddUpTheParticlesOfEachFragment) {
  const std::vector<std::int32_t> of{0, 1, 0, 3, 1};
  const std::vector<double> area{1, 2, 4, 8, 16};
  const auto sizes = fragment_sizes(of, area);
  ASSERT_EQ(sizes.size(), 3U);
  EXPECT_THAT((std::vector{sizes[0].size, sizes[1].size, sizes[2].size}), ElementsAre(5, 18, 8));
  EXPECT_THAT((std::vector{sizes[0].number, sizes[1].number, sizes[2].number}),
              ElementsAre(0, 1, 3));
  EXPECT_THAT((std::vector{sizes[0].particles, sizes[1].particles, sizes[2].particles}),
              ElementsAre(2, 2, 1));
}

// Nine pieces of one unit of area and one of 91.
TEST(FragmentSizes, AreCountedOrWeighed) {
  using Weight = SizeDistribution::Weight;
  std::vector<FragmentSize> pieces;
  for (int i = 0; i < 10; ++i) pieces.push_back({i, 1, i == 4 ? 91.0 : 1.0});
  const SizeDistribution by_number(pieces, Weight::number), by_area(pieces, Weight::size);
  const double small = equivalent_diameter(1, 2), large = equivalent_diameter(91, 2);
  EXPECT_DOUBLE_EQ(small * small * std::numbers::pi / 4, 1);
  EXPECT_DOUBLE_EQ(equivalent_diameter(std::numbers::pi / 6, 3), 1);  // a sphere
  EXPECT_EQ(by_number.diameter(0.1), small);
  EXPECT_EQ(by_number.diameter(0.9), small);
  EXPECT_EQ(by_number.diameter(0.91), large);
  EXPECT_EQ(by_area.diameter(0.09), small);
  EXPECT_EQ(by_area.diameter(0.1), large);
  EXPECT_EQ(by_area.shares().back(), 1);
  EXPECT_TRUE(std::ranges::is_sorted(by_area.diameters()));
}

}  // namespace
}  // namespace pulvis
