// Outlines of what a preview fills.
#include "cli/preview/rims.hpp"

#include <gmock/gmock.h>

namespace pulvis {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

// Eight quads around a hole: nodes 0-15, four a row.
std::vector<Face> quads_around_a_hole() {
  std::vector<Face> faces;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      const std::size_t first = 4 * row + column;
      if (row != 1 || column != 1) faces.push_back({first, first + 1, first + 5, first + 4});
    }
  return faces;
}

TEST(Rims, AreTheOutlineCounterClockwiseAndTheHoleClockwise) {
  EXPECT_THAT(rims_of(quads_around_a_hole()),
              UnorderedElementsAre(ElementsAre(0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4),
                                   ElementsAre(5, 9, 10, 6)));
}

TEST(Rims, OfPartsThatAreApartAreApart) {
  EXPECT_THAT(rims_of({{0, 1, 2}, {3, 4, 5}}),
              UnorderedElementsAre(ElementsAre(0, 1, 2), ElementsAre(3, 4, 5)));
}

TEST(ConvexHull, HasTheCornersAlone) {
  const auto hull = convex_hull({{0, 0}, {2, 0}, {1, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}, {0, 0}});
  EXPECT_THAT(hull,
              ElementsAre(PlanePoint{0, 0}, PlanePoint{2, 0}, PlanePoint{2, 2}, PlanePoint{0, 2}));
}

TEST(ConvexHull, OfPointsOnALineIsItsEnds) {
  EXPECT_THAT(convex_hull({{0, 0}, {1, 1}, {3, 3}, {2, 2}}), SizeIs(2));
  EXPECT_THAT(convex_hull({{1, 1}, {1, 1}}), SizeIs(1));
}

}  // namespace
}  // namespace pulvis
