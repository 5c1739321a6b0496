// Which STL files with several closed surfaces are accepted.
#include "scenes/checks/solids/stl_bodies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/checks/solids/thin_walls.hpp"
#include "scenes/meshes/hexahedra/stl.hpp"

namespace pulvis::space {
namespace {

using testing::HasSubstr;

std::vector<Triangle> box_between(const Vec3& low, const Vec3& high) {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const auto corner = [&](bool a, bool b) {
        Vec3 p;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        p[axis] = (upper ? high : low)[axis];
        p[u] = ((upper ? a : b) ? high : low)[u];
        p[v] = ((upper ? b : a) ? high : low)[v];
        return p;
      };
      triangles.push_back({corner(false, false), corner(true, false), corner(true, true)});
      triangles.push_back({corner(false, false), corner(true, true), corner(false, true)});
    }
  return triangles;
}

std::vector<Triangle> inwards(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

std::string problem_of(const std::vector<std::vector<Triangle>>& parts) {
  std::vector<Triangle> all;
  for (const std::vector<Triangle>& part : parts) all.insert(all.end(), part.begin(), part.end());
  try {
    refuse_touching_bodies(all);
  } catch (const BadStl& problem) {
    return problem.what();
  }
  return "";
}

TEST(StlBodies, ApartOrWithCavitiesAreAccepted) {
  const auto box = box_between({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(problem_of({box}), "");
  EXPECT_EQ(problem_of({box, box_between({1.001, 0, 0}, {2, 1, 1})}), "");
  const auto cavity = inwards(box_between({-1, -1, -1}, {2, 2, 2})),
             hull = box_between({-2, -2, -2}, {3, 3, 3});
  EXPECT_EQ(problem_of({hull, cavity}), "");
  EXPECT_EQ(problem_of({box, hull, cavity}), "");  // a body in the cavity
}

TEST(StlBodies, TheThinnestWallIsFound) {
  // A plate, and a box with a cavity that leaves a wall of a tenth on one side.
  const auto plate = box_between({-5, -5, 0}, {5, 5, 0.01});
  const auto wall = thinnest_wall(plate, 0.5);
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->thickness, 0.01, 1e-14);
  EXPECT_FALSE(thinnest_wall(plate, 0.009));
  std::vector<Triangle> hollow = box_between({0, 0, 0}, {3, 3, 3});
  for (const Triangle& t : inwards(box_between({1, 1, 1}, {2.9, 2, 2}))) hollow.push_back(t);
  const auto side = thinnest_wall(hollow, 0.5);
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->thickness, 0.1, 1e-14);
  EXPECT_GT(side->at.x(), 2.8);
}

TEST(StlBodies, ThatTouchOrOverlapAreRefused) {
  const auto box = box_between({0, 0, 0}, {1, 1, 1});
  EXPECT_THAT(problem_of({box, box}), HasSubstr("given twice"));
  EXPECT_THAT(problem_of({box, box_between({1, 0, 0}, {2, 1, 1})}),
              HasSubstr("parts that touch must be one body"));
  for (const Vec3& low : {Vec3(1, 0.2, 0.2), Vec3(0.3, 0.3, 0.2), Vec3(1, 1, 1)})
    EXPECT_THAT(problem_of({box, box_between(low, low + Vec3(1, 2, 3))}),
                HasSubstr("touch or overlap"));
}

TEST(StlBodies, InTheWrongPlaceAreRefused) {
  const auto box = box_between({0, 0, 0}, {1, 1, 1}), hull = box_between({-2, -2, -2}, {3, 3, 3});
  EXPECT_THAT(problem_of({hull, box}), HasSubstr("lies inside another body"));
  EXPECT_THAT(problem_of({hull, inwards(box_between({4, 0, 0}, {5, 1, 1}))}),
              HasSubstr("faces inwards"));
}

}  // namespace
}  // namespace pulvis::space
