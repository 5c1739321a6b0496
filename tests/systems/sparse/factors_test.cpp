// Sparse factors, against dense ones.
#include "systems/sparse/factors.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace pulvis::sparse {
namespace {

template <class Real>
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Pairs = std::set<std::pair<int, int>>;  // row > column

// A symmetric matrix of blocks, with the values in the order of the factors.
template <class Real>
struct Sample {
  std::vector<std::int32_t> begin{0}, row;
  std::vector<Real> values;
  Matrix<Real> dense;

  BlockGraph graph() const { return {begin, row}; }
};

template <class Real>
Sample<Real> sample(int blocks, const Pairs& pairs, bool definite) {
  Sample<Real> s;
  s.dense.setZero(3 * blocks, 3 * blocks);
  std::mt19937 random(7);
  const auto number = [&] { return static_cast<Real>(random()) / std::mt19937::max() - Real(0.5); };
  for (int c = 0; c < blocks; ++c) {
    s.row.push_back(c);
    for (int r = c + 1; r < blocks; ++r)
      if (pairs.contains({r, c})) s.row.push_back(r);
    s.begin.push_back(static_cast<std::int32_t>(s.row.size()));
    for (int j = 0; j < 3; ++j)
      for (const int r : s.graph().rows_of(c))
        for (int i = r == c ? j : 0; i < 3; ++i) {
          // The diagonal dominates, so that pivots keep its sign.
          const Real sign = definite || c % 2 == 0 ? 1 : -1;
          const Real value = r == c && i == j ? sign * (6 + blocks) : number();
          s.dense(3 * r + i, 3 * c + j) = s.dense(3 * c + j, 3 * r + i) = value;
          s.values.push_back(value);
        }
  }
  return s;
}

Pairs random_pairs(int blocks, int count) {
  std::mt19937 random(3);
  Pairs pairs;
  for (int i = 0; i < count; ++i) {
    const int a = static_cast<int>(random() % static_cast<unsigned>(blocks)),
              b = static_cast<int>(random() % static_cast<unsigned>(blocks));
    if (a != b) pairs.insert({std::max(a, b), std::min(a, b)});
  }
  return pairs;
}

Pairs all_pairs(int blocks) {
  Pairs pairs;
  for (int r = 0; r < blocks; ++r)
    for (int c = 0; c < r; ++c) pairs.insert({r, c});
  return pairs;
}

Pairs chain(int blocks) {
  Pairs pairs;
  for (int r = 1; r < blocks; ++r) pairs.insert({r, r - 1});
  return pairs;
}

// The first block last, and so on.
std::vector<std::int32_t> backwards(int blocks) {
  std::vector<std::int32_t> position;
  for (int b = 0; b < blocks; ++b) position.push_back(blocks - 1 - b);
  return position;
}

template <class Real>
void expect_solved(int blocks, const Pairs& pairs, bool definite = true) {
  const Sample<Real> s = sample<Real>(blocks, pairs, definite);
  Factors<Real> factors(s.graph(), backwards(blocks));
  ASSERT_TRUE(factors.factorise(s.values));
  Matrix<Real> x = Matrix<Real>::Random(3 * blocks, 7);
  const Matrix<Real> forces = x;
  factors.solve({x.data(), static_cast<std::size_t>(x.size())});
  const Matrix<Real> expected = s.dense.partialPivLu().solve(forces);
  EXPECT_LT((x - expected).norm() / expected.norm(), 100 * std::numeric_limits<Real>::epsilon());
  const auto negative = std::ranges::count_if(factors.pivots(), [](Real d) { return d < 0; });
  EXPECT_EQ(negative, definite ? 0 : 3 * (blocks / 2));
  // Each column as if it were alone.
  for (int n = 0; n < forces.cols(); ++n) {
    Matrix<Real> alone = forces.col(n);
    factors.solve({alone.data(), static_cast<std::size_t>(alone.size())});
    EXPECT_EQ(alone, x.col(n)) << n;
  }
}

TEST(SparseFactors, SolveWhatDenseOnesSolve) {
  for (const int blocks : {1, 2, 5, 17, 40, 90}) {
    SCOPED_TRACE(blocks);
    expect_solved<double>(blocks, random_pairs(blocks, 2 * blocks));
    expect_solved<double>(blocks, all_pairs(blocks));
    expect_solved<double>(blocks, chain(blocks));
    expect_solved<double>(blocks, {});  // of separate parts
    expect_solved<long double>(blocks, random_pairs(blocks, 3 * blocks));
  }
}

TEST(SparseFactors, HaveNegativePivotsWhereTheMatrixIsIndefinite) {
  expect_solved<double>(60, random_pairs(60, 100), false);
  expect_solved<long double>(40, chain(40), false);
}

TEST(SparseFactors, AreMadeAgainFromOtherValues) {
  Sample<double> s = sample<double>(30, random_pairs(30, 60), true);
  Factors<double> factors(s.graph(), backwards(30)), fresh(s.graph(), backwards(30));
  ASSERT_TRUE(factors.factorise(s.values));
  for (double& value : s.values) value *= 1.25;
  ASSERT_TRUE(factors.factorise(s.values));
  ASSERT_TRUE(fresh.factorise(s.values));
  EXPECT_TRUE(std::ranges::equal(factors.pivots(), fresh.pivots()));
}

TEST(SparseFactors, AreRefusedWithoutAPivot) {
  for (const double wrong :
       {0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Sample<double> s = sample<double>(4, {}, true);
    s.values[6] = wrong;  // the first of the second block
    EXPECT_FALSE(Factors<double>(s.graph(), backwards(4)).factorise(s.values)) << wrong;
  }
}

// A grid of squares has supernodes, in whose order every parent follows its children.
TEST(Supernodes, HaveEveryBlockOnceAndTheRowsOfTheFactors) {
  constexpr int side = 12, blocks = side * side;
  Pairs pairs;
  for (int i = 0; i < blocks; ++i)
    for (const int step : {1, side - 1, side, side + 1})
      if (i + step < blocks && std::abs((i + step) % side - i % side) <= 1)
        pairs.insert({i + step, i});
  const Sample<double> s = sample<double>(blocks, pairs, true);
  const Supernodes nodes = supernodes_of(s.graph(), backwards(blocks));
  EXPECT_EQ(std::set(nodes.position.begin(), nodes.position.end()).size(), std::size_t(blocks));
  EXPECT_EQ(nodes.first.back(), blocks);
  // The pattern of the dense factors, in this order: all of it is stored, and little else.
  Eigen::MatrixXd ordered(3 * blocks, 3 * blocks);
  for (int r = 0; r < blocks; ++r)
    for (int c = 0; c < blocks; ++c)
      ordered.block<3, 3>(3 * nodes.position[std::size_t(r)], 3 * nodes.position[std::size_t(c)]) =
          s.dense.block<3, 3>(3 * r, 3 * c);
  const Eigen::MatrixXd l = ordered.llt().matrixL();
  std::size_t stored = 0, needed = 0;
  for (int n = 0; n < nodes.size(); ++n) {
    const auto below = nodes.rows_of(n);
    EXPECT_TRUE(std::ranges::is_sorted(below));
    for (int c = nodes.first[std::size_t(n)]; c < nodes.first[std::size_t(n) + 1]; ++c) {
      EXPECT_EQ(nodes.of_column[std::size_t(c)], n);
      for (int r = c; r < blocks; ++r) {
        const bool is_stored =
            r < nodes.first[std::size_t(n) + 1] || std::ranges::binary_search(below, r);
        const bool is_needed = l.block<3, 3>(3 * r, 3 * c).norm() > 0;
        EXPECT_TRUE(is_stored || !is_needed) << r << ' ' << c;
        stored += is_stored;
        needed += is_needed;
      }
    }
  }
  EXPECT_LT(double(stored), 1.3 * double(needed));
}

}  // namespace
}  // namespace pulvis::sparse
