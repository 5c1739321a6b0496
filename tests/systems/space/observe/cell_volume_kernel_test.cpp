// Volumes in cells: exact for polyhedra, whatever the grid and wherever they stand; circles in rectangles.
#include "systems/space/observe/cell_volume_kernel.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <numeric>

namespace pulvis::space::kernels {
namespace {

using Vec3 = Eigen::Vector3d;
using Triangle = std::array<Vec3, 3>;

Point point_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// A box about the origin, turned and moved.
std::vector<Triangle> box_surface(const Vec3& half, const Eigen::Isometry3d& place) {
  std::vector<Triangle> all;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double u, double v) {
        Vec3 p = Vec3::Zero();
        p[axis] = side * half[axis];
        p[(axis + 1) % 3] = u * half[(axis + 1) % 3];
        p[(axis + 2) % 3] = side * v * half[(axis + 2) % 3];  // outward either way
        return Vec3(place * p);
      };
      all.push_back({corner(-1, -1), corner(1, -1), corner(1, 1)});
      all.push_back({corner(-1, -1), corner(1, 1), corner(-1, 1)});
    }
  return all;
}

// An icosphere would do as well: here rings of a sphere between its poles.
std::vector<Triangle> ball_surface(double radius, int rings, const Vec3& middle) {
  const auto at = [&](int ring, int sector) {
    const double down = std::numbers::pi * ring / rings, round = std::numbers::pi * sector / rings;
    return Vec3(middle + radius * Vec3(std::sin(down) * std::cos(round),
                                       std::sin(down) * std::sin(round), std::cos(down)));
  };
  std::vector<Triangle> all;
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < 2 * rings; ++s) {
      if (r > 0) all.push_back({at(r, s), at(r + 1, s), at(r, s + 1)});
      if (r + 1 < rings) all.push_back({at(r, s + 1), at(r + 1, s), at(r + 1, s + 1)});
    }
  return all;
}

double volume_of(const std::vector<Triangle>& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface) sum += a.dot(b.cross(c)) / 6;
  return sum;
}

std::vector<double> cells_of(const Grid& grid, const std::vector<Triangle>& surface) {
  Eigen::AlignedBox3d box;
  for (const Triangle& t : surface)
    for (const Vec3& p : t) box.extend(p);
  CellVolumes volumes(grid, point_of(box.min()), point_of(box.max()));
  for (const auto& [a, b, c] : surface) volumes.add(point_of(a), point_of(b), point_of(c));
  std::vector<double> cells(
      static_cast<std::size_t>(grid[0].count * grid[1].count * grid[2].count));
  volumes.finish([&](std::size_t cell, double volume) { cells[cell] += volume; });
  return cells;
}

Grid grid_of(double low, double high, std::array<int, 3> count) {
  Grid grid;
  for (std::size_t k = 0; k < 3; ++k) grid[k] = {low, (high - low) / count[k], count[k]};
  return grid;
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(CellVolumes, OfABoxAlongTheAxesAreThoseOfTheOverlap) {
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translation() = Vec3(0.2, -0.1, 0.3);
  const Vec3 half(0.5, 0.3, 0.7);
  const Grid grid = grid_of(-1, 1, {4, 5, 3});
  const auto cells = cells_of(grid, box_surface(half, place));
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 4; ++i) {
        double overlap = 1;
        for (const auto& [axis, n] : {std::pair{0, i}, {1, j}, {2, k}}) {
          const GridAxis& lines = grid[static_cast<std::size_t>(axis)];
          const double middle = place.translation()[axis];
          overlap *= std::max(0.0, std::min(lines.line(n + 1), middle + half[axis]) -
                                       std::max(lines.line(n), middle - half[axis]));
        }
        EXPECT_NEAR(cells[static_cast<std::size_t>((k * 5 + j) * 4 + i)], overlap, 1e-12);
      }
}

TEST(CellVolumes, AddUpToTheBodyWhateverTheGrid) {
  Eigen::Isometry3d place(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  place.translation() = Vec3(0.05, 0.1, -0.07);
  for (const auto& surface :
       {box_surface({0.3, 0.4, 0.5}, place), ball_surface(0.8, 12, {0.1, 0, 0.05})})
    for (const auto& count : {std::array{1, 1, 1}, {3, 2, 5}, {16, 16, 16}})
      EXPECT_NEAR(sum(cells_of(grid_of(-1, 1, count), surface)), volume_of(surface), 1e-12);
}

TEST(CellVolumes, OfACoarseGridAreTheSumsOfAFineOne) {
  const auto surface = ball_surface(0.9, 10, {0.2, -0.3, 0.1});  // and reaches out of the grid
  const auto coarse = cells_of(grid_of(-1, 1, {2, 2, 2}), surface);
  const auto fine = cells_of(grid_of(-1, 1, {8, 8, 8}), surface);
  std::vector<double> summed(8);
  for (int c = 0; c < 512; ++c)
    summed[static_cast<std::size_t>(c % 8 / 4 + c / 8 % 8 / 4 * 2 + c / 64 / 4 * 4)] +=
        fine[static_cast<std::size_t>(c)];
  for (std::size_t c = 0; c < 8; ++c) EXPECT_NEAR(coarse[c], summed[c], 1e-12);
  EXPECT_LT(sum(coarse), volume_of(surface) - 0.01);
}

// What stands above, below or beside the grid adds nothing.
TEST(CellVolumes, LeaveOutWhatIsOutside) {
  const Grid grid = grid_of(-1, 1, {3, 3, 3});
  for (const Vec3& away : {Vec3(5, 0, 0), Vec3(0, -5, 0), Vec3(0, 0, 5), Vec3(0, 0, -5)})
    EXPECT_EQ(sum(cells_of(grid, ball_surface(0.5, 8, away))), 0);
}

TEST(CellVolumes, OfABallInTheMiddleAreAlikeInAllOctants) {
  for (const double cell : cells_of(grid_of(-1, 1, {2, 2, 2}), ball_surface(0.8, 16, Vec3::Zero())))
    EXPECT_NEAR(cell, 0.8 * 0.8 * 0.8 * std::numbers::pi / 6, 0.02 * cell);
}

TEST(CircleInARectangle, IsWholeHalfOrAQuarter) {
  constexpr double circle = std::numbers::pi * 4;
  EXPECT_NEAR(circle_in_rectangle(2, {-3, 3}, {-2, 2}), circle, 1e-12);
  EXPECT_NEAR(circle_in_rectangle(2, {0, 3}, {-2, 2}), circle / 2, 1e-12);
  EXPECT_NEAR(circle_in_rectangle(2, {-9, 0}, {0, 2}), circle / 4, 1e-12);
  EXPECT_NEAR(circle_in_rectangle(2, {-1, 0.5}, {-0.5, 1}), 1.5 * 1.5, 1e-12);
  EXPECT_NEAR(circle_in_rectangle(2, {2, 3}, {-1, 1}), 0, 1e-12);
}

TEST(CircleInARectangle, IsTheIntegralOfItsChords) {
  const double x0 = -1.7, x1 = 0.4, y0 = -0.6, y1 = 1.8;
  double area = 0;
  constexpr int lines = 20000;
  for (int i = 0; i < lines; ++i) {
    const double x = x0 + (x1 - x0) * (i + 0.5) / lines, half = std::sqrt(4 - x * x);
    area += (x1 - x0) / lines * std::max(0.0, std::min(y1, half) - std::max(y0, -half));
  }
  EXPECT_NEAR(circle_in_rectangle(2, {x0, x1}, {y0, y1}), area, 1e-6);
}

}  // namespace
}  // namespace pulvis::space::kernels
