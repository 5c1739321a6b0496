// Eight lanes do what eight doubles do: every function of a lane gives the bits of the scalar one.
#include "engine/lane.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "engine/lane_memory.hpp"

#include "tests/helpers/random_values.hpp"

namespace pulvis {
namespace {

using kernels::bits;

constexpr double infinity = std::numeric_limits<double>::infinity();
// Signs, an integer, the ends of the range and a value that is no binary fraction.
constexpr std::array<double, lane_count> mixed_values{-2.5, 0.1, infinity, 1e-300, 4, -0.3, 7, 0};
constexpr std::array<double, lane_count> other_values{3.0, 0.1, -infinity, 7e-301, 4.5, -0.2, 6, 1};
const Lane mixed = Lane::load(mixed_values.data()), other = Lane::load(other_values.data());

template <class OfLanes, class OfDoubles>
void expect_same_bits(const OfLanes& lanes, const OfDoubles& doubles) {
  kernels::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Lane a = random.lane(-10, 10), b = random.lane(-10, 10), c = random.lane(-10, 10);
    const Lane result = lanes(a, b, c);
    for (int l = 0; l < lane_count; ++l)
      ASSERT_EQ(bits(result[l]), bits(doubles(a[l], b[l], c[l]))) << a[l] << " " << b[l];
  }
}

TEST(Lane, ADoubleIsTheSameInEveryLane) {
  const Lane all = 0.1;
  for (int l = 0; l < lane_count; ++l) EXPECT_EQ(all[l], 0.1);
}

TEST(Lane, SelectTakesEachLaneByItsOwnMask) {
  const Lane chosen = select(mixed < other, mixed, other);
  for (int l = 0; l < lane_count; ++l)
    EXPECT_EQ(chosen[l], select(mixed[l] < other[l], mixed[l], other[l])) << l;
}

TEST(Lane, MasksAreTheirBits) {
  for (unsigned m = 0; m < 256; ++m) {
    const LaneMask mask = Lane::from([&](int l) { return m >> l & 1; }) > 0.5;
    EXPECT_EQ(mask.bits(), m);
    EXPECT_EQ(any(mask), m != 0) << m;
    EXPECT_EQ(all(mask), m == 255) << m;
    EXPECT_EQ(LaneMask::of(m).bits(), m);
    EXPECT_EQ((~mask).bits(), 255 - m);
    EXPECT_EQ((mask & LaneMask::of(0x5a)).bits(), m & 0x5a);
    EXPECT_EQ((mask | LaneMask::of(0x5a)).bits(), m | 0x5a);
    for (int l = 0; l < lane_count; ++l) EXPECT_EQ(mask[l], (m >> l & 1) != 0);
  }
}

TEST(Lane, ComparisonsAreTheScalarOnes) {
  const Lane a = Lane::from([](int l) { return l == 7 ? std::nan("") : l % 3; });
  const Lane b = Lane::from([](int l) { return 1 + 0 * l; });
  for (int l = 0; l < lane_count; ++l) {
    EXPECT_EQ((a < b)[l], a[l] < b[l]) << l;
    EXPECT_EQ((a <= b)[l], a[l] <= b[l]) << l;
    EXPECT_EQ((a > b)[l], a[l] > b[l]) << l;
    EXPECT_EQ((a >= b)[l], a[l] >= b[l]) << l;
    EXPECT_EQ((a == b)[l], a[l] == b[l]) << l;
  }
}

TEST(Lane, LeastAndGreatestOfTwoAreTheScalarOnes) {
  for (int l = 0; l < lane_count; ++l) {
    EXPECT_EQ(min(mixed, other)[l], min(mixed[l], other[l])) << l;
    EXPECT_EQ(max(mixed, other)[l], max(mixed[l], other[l])) << l;
  }
  expect_same_bits([](Lane a, Lane b, Lane) { return min(a, b); },
                   [](double a, double b, double) { return min(a, b); });
  expect_same_bits([](Lane a, Lane b, Lane) { return max(a, b); },
                   [](double a, double b, double) { return max(a, b); });
}

TEST(Lane, AbsWholeAndRootAreTheScalarOnes) {
  expect_same_bits([](Lane a, Lane, Lane) { return abs(a); },
                   [](double a, double, double) { return abs(a); });
  expect_same_bits([](Lane a, Lane b, Lane) { return whole(a * b); },
                   [](double a, double b, double) { return std::trunc(a * b); });
  expect_same_bits([](Lane a, Lane, Lane) { return sqrt(abs(a)); },
                   [](double a, double, double) { return std::sqrt(std::abs(a)); });
}

TEST(Lane, FusedMultiplyAddIsRoundedOnce) {
  expect_same_bits([](Lane a, Lane b, Lane c) { return fma(a, b, c); },
                   [](double a, double b, double c) { return std::fma(a, b, c); });
  // (1 + e)(1 - e) - 1 = -e^2: lost wholly when the product is rounded by itself.
  constexpr double e = 0x1p-30;
  EXPECT_EQ(fma(Lane(1 + e), 1 - e, -1.0)[2], -e * e);
  EXPECT_EQ(fma(1 + e, 1 - e, -1.0), -e * e);
}

TEST(Lane, FusedMultiplyAddTakesScalarsInEveryPlace) {
  expect_same_bits([](Lane a, Lane, Lane c) { return fma(a, 0.3, c); },
                   [](double a, double, double c) { return std::fma(a, 0.3, c); });
  expect_same_bits([](Lane, Lane b, Lane) { return fma(0.3, b, 0.7); },
                   [](double, double b, double) { return std::fma(0.3, b, 0.7); });
}

TEST(Packet, HoldsTheLanesOfOneRegister) {
  kernels::Random random(2);
  const Lane a = random.lane(-10, 10), b = random.lane(-10, 10), c = random.lane(-10, 10);
  const Lane whole = select(a < b, fma(a, 0.3, c), sqrt(abs(b)) / c);
  const int lanes = static_cast<int>(Packet::size);
  ASSERT_EQ(parts_of_a_lane * lanes, lane_count);
  for (int part = 0; part < parts_of_a_lane; ++part) {
    const Packet x = part_of(a, part), y = part_of(b, part), z = part_of(c, part);
    const Packet result = select(x < y, fma(x, 0.3, z), sqrt(abs(y)) / z);
    for (int l = 0; l < lanes; ++l)
      EXPECT_EQ(bits(result[l]), bits(whole[part * lanes + l])) << part << " " << l;
  }
}

struct Thing {};
struct Pairs : Component<Thing, double, 2> {};

TEST(Packet, PartsOfAViewAreTheLanesInPlace) {
  std::array<Lane, 6> column;  // three rows of two
  for (int i = 0; i < 6; ++i) entry(column, i) = Lane::from([i](int l) { return 100 * i + l; });
  const ChunkView<Pairs, Lane*> view(column.data());
  const ChunkView<Pairs, const Lane*> read(column.data());
  const int lanes = static_cast<int>(Packet::size);
  for (int part = 0; part < parts_of_a_lane; ++part)
    for (int row = 0; row < 3; ++row)
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < lanes; ++l) {
          const Row<Thing> r(row);
          EXPECT_EQ(part_of(read, part)(r, k)[l], 100 * (2 * row + k) + part * lanes + l);
          part_of(view, part)(r, k)[l] += 0.5;
        }
  for (int i = 0; i < 6; ++i)
    for (int l = 0; l < lane_count; ++l) EXPECT_EQ(entry(column, i)[l], 100 * i + l + 0.5);
}

TEST(LaneMemory, HalvesComeAndGoByThemselves) {
  const std::array<double, 4> low{1, 2, 3, 4}, high{5, 6, 7, 8};
  const Lane a = load_halves(low.data(), high.data()), b = halves(0.1, 0.2);
  std::array<double, 4> back{};
  for (int l = 0; l < lane_count; ++l) {
    EXPECT_EQ(a[l], l + 1);
    EXPECT_EQ(b[l], l < 4 ? 0.1 : 0.2);
  }
  store_half(a, 0, back.data());
  EXPECT_EQ(back, low);
  store_half(a, 1, back.data());
  EXPECT_EQ(back, high);
}

TEST(LaneMemory, PairsTakeTurns) {
  const std::array<double, 2> xy{3, -4};
  const Lane pairs = repeat_pair(xy.data());
  for (int l = 0; l < lane_count; ++l) EXPECT_EQ(pairs[l], xy[static_cast<std::size_t>(l % 2)]);
  const Lane x = Lane::from([](int l) { return l; }), y = Lane::from([](int l) { return 10 + l; });
  std::array<double, 8> out{};
  store_pairs_of_half(x, y, 1, out.data());
  EXPECT_EQ(out, (std::array<double, 8>{4, 14, 5, 15, 6, 16, 7, 17}));

  constexpr std::size_t apart = 3;
  std::array<double, apart * lane_count> list{};
  store_pairs(x, y, list.data(), apart);
  for (std::size_t l = 0; l < lane_count; ++l) {
    EXPECT_EQ(list[apart * l], x[static_cast<int>(l)]);
    EXPECT_EQ(list[apart * l + 1], y[static_cast<int>(l)]);
    EXPECT_EQ(list[apart * l + 2], 0);  // what lies between them is left alone
  }
}

TEST(LaneMemory, SumsOfAHalfArePairwiseInFixedOrder) {
  // Beside 1e16 a one is lost: in pairs both are, one after the other one is, crosswise none.
  const std::array<double, 4> both_lost{1e16, 1, -1e16, 1}, kept{1e16, -1e16, 1, 1};
  const SumsOfHalves sums = sums_of_halves(load_halves(both_lost.data(), kept.data()),
                                           load_halves(kept.data(), both_lost.data()));
  EXPECT_EQ(sums.a, (std::array<double, 2>{0, 2}));
  EXPECT_EQ(sums.b, (std::array<double, 2>{2, 0}));
}

TEST(LaneMemory, LeastAndGreatestLookAtAllLanesOfTheirHalf) {
  for (int l = 0; l < lane_count; ++l) {
    Lane a = 1.0;
    a[l] = -5;
    EXPECT_EQ(min_of_half(a, l / 4), -5) << l;
    EXPECT_EQ(min_of_half(a, 1 - l / 4), 1) << l;
    EXPECT_EQ(greatest_of_half(-a, l / 4), 5) << l;
    EXPECT_EQ(greatest_of_half(a, l / 4), 1) << l;
  }
}

TEST(LaneMemory, ColumnsOfEightRowsAreTheTransposed) {
  std::array<double, 64> matrix;
  std::iota(matrix.begin(), matrix.end(), 0.0);
  std::array<const double*, lane_count> rows;
  for (std::size_t l = 0; l < 8; ++l) rows[l] = matrix.data() + 8 * (7 - l);  // in any order
  const auto columns = columns_of(rows);
  const auto first_four = columns_of<4>(rows);
  for (std::size_t k = 0; k < 8; ++k)
    for (int l = 0; l < lane_count; ++l) {
      EXPECT_EQ(columns[k][l], rows[static_cast<std::size_t>(l)][k]) << k << " " << l;
      if (k < 4) {
        EXPECT_EQ(first_four[k][l], columns[k][l]);
      }
    }
}

TEST(LaneMemory, SixteenFloatsAreComparedAtOnce) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), tiny = 1e-45F;
  constexpr float far = std::numeric_limits<float>::infinity();
  const std::array<float, 16> all{0,    tiny, -1,   1, 2, far, nan, 1,
                                  1.5F, 1,    -far, 0, 3, nan, 1,   1.0000001F};
  for (const float limit : {0.0F, 1.0F, 2.5F, far}) {
    unsigned expected = 0;
    for (unsigned i = 0; i < all.size(); ++i) expected |= (all[i] <= limit ? 1U : 0U) << i;
    EXPECT_EQ(at_most(all.data(), limit), expected) << limit;
  }
}

}  // namespace
}  // namespace pulvis
