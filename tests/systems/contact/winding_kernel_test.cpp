// Crossings of a ray add up to how often a closed chain goes round its start.
#include "systems/contact/winding_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace pulvis::kernels {
namespace {

using Spot = std::array<double, 2>;

int times_round(const std::vector<Spot>& chain, const Spot& q, double angle) {
  int times = 0;
  for (std::size_t i = 0; i < chain.size(); ++i)
    times +=
        crossing(q, {std::cos(angle), std::sin(angle)}, chain[i], chain[(i + 1) % chain.size()]);
  return times;
}

// All rays of a point say the same, those through corners too.
void expect_times(const std::vector<Spot>& chain, const Spot& q, int times) {
  for (int i = 0; i < 360; ++i)
    EXPECT_EQ(times_round(chain, q, i * std::numbers::pi / 180), times) << i << " degrees";
}

TEST(Winding, OfASquareIsOneInsideAndNoneOutside) {
  const std::vector<Spot> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  expect_times(square, {0.5, 0.5}, 1);
  expect_times(square, {1.5, 0.5}, 0);
  expect_times({square.rbegin(), square.rend()}, {0.5, 0.5}, -1);
}

// A bar bent to a ring whose ends have gone through each other by a quarter of a right angle.
TEST(Winding, IsTwoWhereABodyOverlapsItself) {
  constexpr int count = 100;
  constexpr double all = 2.125 * std::numbers::pi;
  std::vector<Spot> bar;
  for (int i = 0; i <= count; ++i)
    bar.push_back({3 * std::cos(all * i / count), 3 * std::sin(all * i / count)});
  for (int i = count; i >= 0; --i)
    bar.push_back({2 * std::cos(all * i / count), 2 * std::sin(all * i / count)});
  const auto at = [](double angle) { return Spot{2.5 * std::cos(angle), 2.5 * std::sin(angle)}; };
  expect_times(bar, at(0.0625 * std::numbers::pi), 2);
  expect_times(bar, at(std::numbers::pi), 1);
  expect_times(bar, {0, 0}, 0);
}

}  // namespace
}  // namespace pulvis::kernels
