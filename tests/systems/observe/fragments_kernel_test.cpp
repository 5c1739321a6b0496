#include "systems/observe/fragments_kernel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pulvis::kernels {
namespace {

using ::testing::ElementsAre;

TEST(DisjointSets, AreNamedByTheirLowestNumberInAnyOrder) {
  DisjointSets apart(3);
  EXPECT_THAT(apart.roots(), ElementsAre(0, 1, 2));
  DisjointSets sets(8);
  for (const auto& [a, b] : {std::pair(7, 5), {3, 2}, {5, 3}, {6, 1}, {7, 2}}) sets.join(a, b);
  EXPECT_THAT(sets.roots(), ElementsAre(0, 1, 2, 2, 4, 2, 1, 2));
  DisjointSets turned(8);
  for (const auto& [a, b] : {std::pair(2, 7), {1, 6}, {3, 5}, {2, 3}, {5, 7}}) turned.join(a, b);
  EXPECT_EQ(turned.roots(), sets.roots());
}

}  // namespace
}  // namespace pulvis::kernels
