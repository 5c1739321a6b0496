// Widths of particles are those of closed forms, however a shape lies in its own axes.
#include "scenes/packing/solids/widths.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/outlines/portable.hpp"

namespace pulvis::space {
namespace {

void expect_widths(const ParticleShape& shape, double least, double middle, double tolerance) {
  const Widths found = widths_of(shape);
  EXPECT_NEAR(found.least, least, tolerance * least);
  EXPECT_NEAR(found.middle, middle, tolerance * middle);
}

TEST(ParticleWidths, OfSmoothShapesAreThoseAlongTheirAxes) {
  expect_widths(SphereShape{1.5}, 1.5, 1.5, 0);
  expect_widths(EllipsoidShape{{3, 1, 0.5}}, 0.5, 1, 1e-12);
  expect_widths(SuperquadricShape{{1, 2, 1.5}, 4, 7}, 1, 1.5, 1e-12);
  expect_widths(CylinderShape{2, 0.8, 0.15}, 0.8, 2, 1e-12);
  expect_widths(CylinderShape{0.8, 2, 0.15}, 0.8, 0.8, 1e-12);
}

// A tetrahedron is thinnest between opposite edges, and square along that direction.
TEST(ParticleWidths, OfCornersDoNotDependOnHowTheyLie) {
  portable::Random random(5);
  for (int i = 0; i < 20; ++i) {
    const auto number = [&] { return random.between(-1, 1); };
    const Rotation turn = i == 0 ? Rotation::Identity()
                                 : Rotation(number(), number(), number(), number()).normalized();
    PolyhedronShape bar, tetrahedron;
    for (int corner = 0; corner < 8; ++corner)
      bar.corners.push_back(turn *
                            Vec3(corner & 1 ? 3 : 0, corner & 2 ? 1 : 0, corner & 4 ? 0.5 : 0));
    for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
      tetrahedron.corners.push_back(turn * corner);
    expect_widths(bar, 0.5, 1, 1e-6);
    expect_widths(tetrahedron, 2, 2, 1e-6);
    bar.rounding = 0.05;
    expect_widths(bar, 0.5, 1, 1e-6);
  }
}

}  // namespace
}  // namespace pulvis::space
