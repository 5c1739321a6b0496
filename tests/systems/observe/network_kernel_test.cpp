// Contact networks as a whole: fabric, rose and force chains of arrangements whose answer is known.
#include "systems/observe/network_kernel.hpp"

#include <gtest/gtest.h>

#include "systems/observe/force_chain_kernel.hpp"

namespace pulvis::kernels {
namespace {

using std::numbers::pi;

ContactLink<TwoD> towards(double angle, double force) {
  ContactLink<TwoD> link;
  link.normal = {std::cos(angle), std::sin(angle)};
  link.force = {force * link.normal[0], force * link.normal[1]};
  return link;
}

TEST(Fabric, OfRegularArrangementsIsIsotropic) {
  for (const int directions : {2, 3, 4, 7}) {
    std::vector<ContactLink<TwoD>> links;
    for (int k = 0; k < directions; ++k) links.push_back(towards(0.3 + pi * k / directions, 1));
    const Fabric f = fabric(links);
    EXPECT_NEAR(f.xx, 0.5, 1e-15) << directions;
    EXPECT_NEAR(f.yy, 0.5, 1e-15) << directions;
    EXPECT_NEAR(f.anisotropy(), 0, 1e-15) << directions;
  }
}

TEST(Fabric, OfParallelContactsPointsTheirWay) {
  for (const double angle : {0.0, 0.4, 1.5, -0.7}) {
    const Fabric f = fabric(std::vector{towards(angle, 2), towards(angle + pi, 5)});
    EXPECT_NEAR(f.xx + f.yy, 1, 1e-15);
    EXPECT_NEAR(f.anisotropy(), 1, 1e-15);
    EXPECT_NEAR(f.angle(), angle, 1e-14);
  }
}

TEST(Rose, CountsOppositeNormalsAlikeAndWeighsThem) {
  const std::vector links{towards(0, 1), towards(pi, 1), towards(pi / 2, 6), towards(-0.04, 0)};
  const Rose r = rose(links);
  EXPECT_DOUBLE_EQ(r.number[0], 0.75);
  EXPECT_DOUBLE_EQ(r.number[9], 0.25);
  EXPECT_DOUBLE_EQ(r.force[0], 0.25);
  EXPECT_DOUBLE_EQ(r.force[9], 0.75);
}

TEST(Rose, SumsToOneWhateverTheDirections) {
  std::vector<ContactLink<TwoD>> links;
  for (int k = 0; k < 1000; ++k) links.push_back(towards(0.37 * k, 1 + k % 7));
  const Rose r = rose(links);
  double number = 0, force = 0;
  for (std::size_t s = 0; s < rose_sectors; ++s) {
    number += r.number[s];
    force += r.force[s];
    EXPECT_NEAR(r.number[s], 1.0 / rose_sectors, 0.01) << s;
  }
  EXPECT_NEAR(number, 1, 1e-12);
  EXPECT_NEAR(force, 1, 1e-12);
}

TEST(MajorCompression, IsThePrincipalStressOfMohrsCircle) {
  for (const double turn : {0.0, 0.3, 1.2, 2.8}) {
    const double c = std::cos(turn), s = std::sin(turn), minimum = -50, maximum = 8;
    // least along (c, s), most across.
    const PlaneStress stress{minimum * c * c + maximum * s * s, minimum * s * s + maximum * c * c,
                             (minimum - maximum) * s * c};
    const MajorCompression major = major_compression(stress);
    EXPECT_NEAR(major.size, 50, 1e-12);
    EXPECT_NEAR(std::abs(major.direction[0] * c + major.direction[1] * s), 1, 1e-14) << turn;
  }
}

// A column of four strong particles between two of weak ones; all neighbours touch.
//   0 1 2
//   3 4 5
//   6 7 8
//   9 10 11
struct Columns {
  std::vector<PlaneStress> stress;
  std::vector<Point> centre;
  std::vector<TouchingPair<2>> touching;
  Columns() {
    for (int p = 0; p < 12; ++p) {
      const int x = p % 3, y = p / 3;
      stress.push_back({0, x == 1 ? -100.0 : -10.0, 0});
      centre.push_back({1.0 * x, -1.0 * y});
      if (x < 2) touching.push_back({p, p + 1});
      if (y < 3) touching.push_back({p, p + 3});
    }
  }
  std::vector<std::int32_t> chains() const {
    std::vector<MajorCompression<2>> load;
    for (const PlaneStress& s : stress) load.push_back(major_compression(s));
    return chains_of<2>(load, centre, touching);
  }
};

TEST(ForceChains, FollowTheLoadedColumn) {
  EXPECT_EQ(Columns().chains(), (std::vector<std::int32_t>{0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}));
}

// Compression across the column leads to the weak neighbours only.
TEST(ForceChains, DoNotLeadAcrossTheCompression) {
  Columns columns;
  for (const std::size_t p : {1U, 4U, 7U, 10U}) columns.stress[p] = {-100, 0, 0};
  EXPECT_EQ(columns.chains(), std::vector<std::int32_t>(12, 0));
}

TEST(ForceChains, AreBrokenByAParticleThatBearsLittleAndNeedThree) {
  Columns columns;
  columns.stress[7] = {0, -10, 0};
  EXPECT_EQ(columns.chains(), std::vector<std::int32_t>(12, 0));  // two and one are left
}

TEST(ForceChains, TurnWithThePowder) {
  Columns columns;
  const double c = std::cos(0.6), s = std::sin(0.6);
  for (std::size_t p = 0; p < 12; ++p) {
    const double load = columns.stress[p].yy;  // along (0, 1) before, along (-s, c) now
    columns.stress[p] = {load * s * s, load * c * c, -load * s * c};
    const auto [x, y] = columns.centre[p];
    columns.centre[p] = {c * x - s * y, s * x + c * y};
  }
  EXPECT_EQ(columns.chains(), Columns().chains());
}

// The same column, the lower half moved by a period of 5 to the side.
TEST(ForceChains, LeadAcrossTheBordersOfAPeriodicCell) {
  Columns columns;
  for (std::size_t p = 6; p < 12; ++p) columns.centre[p][0] += 5;
  EXPECT_EQ(columns.chains(), std::vector<std::int32_t>(12, 0));
  for (TouchingPair<2>& pair : columns.touching)
    if (pair.first < 6 && pair.second >= 6) pair.period = {-5, 0};
  EXPECT_EQ(columns.chains(), Columns().chains());
}

TEST(ForceChains, NeedCompression) {
  Columns columns;
  for (PlaneStress& stress : columns.stress) stress.yy = -stress.yy;
  EXPECT_EQ(columns.chains(), std::vector<std::int32_t>(12, 0));
}

}  // namespace
}  // namespace pulvis::kernels
