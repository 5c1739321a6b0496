#include "scenes/outlines/closed_spline.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cmath>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2>;

// Second derivatives g of a spline with knots f: R g = Q^T f.
struct System {
  Matrix q, r;
};

System system_of(const std::vector<double>& step) {
  const auto n = static_cast<int>(step.size());
  std::vector<Eigen::Triplet<double>> q, r;
  for (int i = 0; i < n; ++i) {
    const int before = (i + n - 1) % n, after = (i + 1) % n;
    const double left = step[static_cast<std::size_t>(before)];
    const double right = step[static_cast<std::size_t>(i)];
    q.emplace_back(before, i, 1 / left);
    q.emplace_back(i, i, -1 / left - 1 / right);
    q.emplace_back(after, i, 1 / right);
    r.emplace_back(i, i, (left + right) / 3);
    r.emplace_back(i, before, left / 6);
    r.emplace_back(i, after, right / 6);
  }
  System system{Matrix(n, n), Matrix(n, n)};
  system.q.setFromTriplets(q.begin(), q.end());
  system.r.setFromTriplets(r.begin(), r.end());
  return system;
}

std::vector<double> chords(const std::vector<Vec2>& points) {
  std::vector<double> step;
  for (std::size_t i = 0; i < points.size(); ++i)
    step.push_back((points[(i + 1) % points.size()] - points[i]).norm());
  return step;
}

Columns columns_of(const std::vector<Vec2>& points) {
  Columns columns(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i)
    columns.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  return columns;
}

std::vector<Vec2> points_of(const Columns& columns) {
  std::vector<Vec2> points;
  for (Eigen::Index i = 0; i < columns.rows(); ++i) points.emplace_back(columns.row(i).transpose());
  return points;
}

}  // namespace

ClosedSpline closed_spline(const std::vector<Vec2>& points) {
  const std::vector<double> step = chords(points);
  const System system = system_of(step);
  const Eigen::SimplicialLDLT<Matrix> solver(system.r);
  const Columns bend = solver.solve(Columns(system.q.transpose() * columns_of(points)));
  return {step, points, points_of(bend)};
}

std::vector<Vec2> smoothed_points(const std::vector<Vec2>& points, double distance) {
  const System system = system_of(chords(points));
  const Columns given = columns_of(points);
  const Columns right = system.q.transpose() * given;
  const Matrix square = system.q.transpose() * system.q;
  Eigen::SimplicialLDLT<Matrix> solver;
  const auto knots = [&](double weight) -> Columns {
    solver.compute(Matrix(system.r + weight * square));
    return given - weight * (system.q * Columns(solver.solve(right)));
  };
  // The distance increases with the bending weight, whose unit is m^3.
  double perimeter = 0;
  for (const double length : chords(points)) perimeter += length;
  double low = -36, high = 6;  // exponents of e
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    const Columns at = knots(perimeter * perimeter * perimeter * portable::exp(middle));
    const double root_mean_square =
        std::sqrt((at - given).squaredNorm() / static_cast<double>(points.size()));
    (root_mean_square < distance ? low : high) = middle;
  }
  return points_of(knots(perimeter * perimeter * perimeter * portable::exp(0.5 * (low + high))));
}

}  // namespace pulvis
