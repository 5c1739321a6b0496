// Lattices: their densities are the closed forms of crystallography, neighbours touch, and they stand between flat walls.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/scenes/packing/solids/packed_scene.hpp"

namespace pulvis::space {
namespace {

using Kind = PackingSpec::Kind;
using std::numbers::pi;

struct Lattice {
  Kind kind;
  double spacing;  // at which balls of diameter 1 touch
  double density;  // of the whole space
  int neighbours;  // of a particle inside
};
const Lattice lattices[] = {
    {Kind::cubic, 1, pi / 6, 6},
    {Kind::body_centred, 2 / std::numbers::sqrt3, std::numbers::sqrt3* pi / 8, 8},
    {Kind::face_centred, std::numbers::sqrt2, std::numbers::sqrt2* pi / 6, 12},
    {Kind::hexagonal, 1, std::numbers::sqrt2* pi / 6, 12}};

PackingSpec lattice_of(const Lattice& lattice, int cells) {
  PackingSpec packing;
  packing.kind = lattice.kind;
  packing.cells = {cells, cells, cells};
  packing.spacing = lattice.spacing;
  packing.container.corner = {0.5, -0.25, 2};
  return packing;
}

double distance_to_nearest(const std::vector<BodySpec>& bodies, std::size_t i) {
  double least = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < bodies.size(); ++k)
    if (k != i) least = std::min(least, (bodies[k].position - bodies[i].position).norm());
  return least;
}

class Lattices : public testing::TestWithParam<Lattice> {};

TEST_P(Lattices, NeighboursTouchAndInsideThereAreAsManyAsKnown) {
  const Scene scene = scene_of({SphereShape{1}}, lattice_of(GetParam(), 5));
  const std::vector<BodySpec> bodies = place_bodies(scene);
  EXPECT_EQ(bodies.size(), particle_count(scene.packings[0]));
  std::size_t most = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    EXPECT_NEAR(distance_to_nearest(bodies, i), 1, 1e-12);
    most = std::max(most,
                    static_cast<std::size_t>(std::ranges::count_if(bodies, [&](const BodySpec& b) {
                      const double d = (b.position - bodies[i].position).norm();
                      return d > 0.5 && d < 1 + 1e-9;
                    })));
  }
  EXPECT_EQ(most, GetParam().neighbours);
}

// The number of particles grows with n^3, what walls leave empty with n^2: of two sizes the bulk is known.
TEST_P(Lattices, FillAsMuchOfSpaceAsKnown) {
  double volume[2], room[2];
  for (int i = 0; i < 2; ++i) {
    const PackingSpec packing = lattice_of(GetParam(), 12 + 12 * i);
    Vec3 low = Vec3::Constant(1e9), high = -low;
    const std::vector<BodySpec> bodies = place_bodies(scene_of({SphereShape{1}}, packing));
    for (const BodySpec& body : bodies) {
      low = low.cwiseMin(body.position);
      high = high.cwiseMax(body.position);
    }
    volume[i] = std::cbrt(static_cast<double>(bodies.size()) * pi / 6);
    room[i] = std::cbrt((high - low).prod());
  }
  const double side = (volume[1] - volume[0]) / (room[1] - room[0]);
  EXPECT_NEAR(side * side * side, GetParam().density, 2e-3);
}

// Whole particles alone: the outermost touch planes through the corner, and the punch rests on the highest.
TEST_P(Lattices, StandOnPlanesThroughTheCorner) {
  const PackingSpec packing = lattice_of(GetParam(), 4);
  Vec3 low = Vec3::Constant(1e9), high = -low;
  for (const BodySpec& body : place_bodies(scene_of({SphereShape{1}}, packing))) {
    low = low.cwiseMin(body.position);
    high = high.cwiseMax(body.position);
    EXPECT_EQ(body.rotation.coeffs(), Rotation::Identity().coeffs());
  }
  EXPECT_LT((low - packing.container.corner - Vec3::Constant(0.5)).norm(), 1e-12);
  EXPECT_NEAR(high.z() + 0.5, top_of_lattice(packing), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Lattices, testing::ValuesIn(lattices));

// As in two dimensions: [[body]] and [[packing]] in the order of the file.
TEST(PlaceBodies, FollowTheOrderOfTheFile) {
  PackingSpec packing = lattice_of(lattices[0], 2);
  packing.mark = {10, 1};
  Scene scene = scene_of({SphereShape{1}}, packing);
  BodySpec before, behind;
  before.position = {1, 2, 3};
  before.mark = {5, 1};
  behind.position = {4, 5, 6};
  behind.mark = {20, 1};
  scene.bodies = {behind, before};
  const std::vector<BodySpec> bodies = place_bodies(scene);
  ASSERT_EQ(bodies.size(), 10u);
  EXPECT_EQ(bodies.front().position, before.position);
  EXPECT_EQ(bodies.back().position, behind.position);
}

}  // namespace
}  // namespace pulvis::space
