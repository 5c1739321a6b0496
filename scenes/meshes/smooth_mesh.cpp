#include "scenes/meshes/smooth_mesh.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/entry.hpp"
#include "engine/portable_math.hpp"
#include "scenes/meshes/descent.hpp"
#include "scenes/meshes/newton.hpp"

namespace pulvis {
namespace {

class Quality {
 public:
  Quality(const std::vector<Point>& nodes, const std::vector<Quad>& quads, std::size_t fixed,
          double size_share)
      : quads_(quads),
        size_share_(size_share),
        fixed_(2 * static_cast<Eigen::Index>(fixed)),
        x_(2 * static_cast<Eigen::Index>(nodes.size())) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) x_[static_cast<Eigen::Index>(2 * i + k)] = nodes[i][k];
    double area = 0;
    for (const Quad& quad : quads)
      for (std::size_t k = 0; k < 4; ++k) area += 0.25 * determinant(x_, quad, k);
    scale_ = std::sqrt(static_cast<double>(quads.size()) / area);
    x_ *= scale_;
  }

  const Eigen::VectorXd& start() const { return x_; }
  double scale() const { return scale_; }
  static double longest_move(const Eigen::VectorXd& direction) {
    return direction.reshaped(2, direction.size() / 2).colwise().norm().maxCoeff();
  }

  double min_determinant(const Eigen::VectorXd& x) const {
    double minimum = std::numeric_limits<double>::max();
    for (const Quad& quad : quads_)
      for (std::size_t k = 0; k < 4; ++k) minimum = std::min(minimum, determinant(x, quad, k));
    return minimum;
  }

  // The mean and its gradient; `bound` regularises 1/determinant (0: folded elements are infinitely bad).
  double value(const Eigen::VectorXd& x, double bound, Eigen::VectorXd& gradient) const {
    gradient.setZero(x.size());
    double sum = 0;
    for (const Quad& quad : quads_)
      for (std::size_t k = 0; k < 4; ++k) sum += corner(x, quad, k, bound, gradient);
    const double share = 1 / (4.0 * static_cast<double>(quads_.size()));
    gradient *= share;
    gradient.head(fixed_).setZero();
    return share * sum;
  }

  // Second derivatives over the free coordinates, lower triangle; `convex`: the part that is positive definite
  // everywhere.
  newton::Sparse curvature(const Eigen::VectorXd& x, double bound, bool convex) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(36 * quads_.size());
    for (const Quad& quad : quads_) {
      const Matrix8 h = curvature(x, quad, bound, convex);
      for (Eigen::Index i = 0; i < 8; ++i)
        for (Eigen::Index j = 0; j < 8; ++j) {
          const Eigen::Index row = coordinate(quad, i), column = coordinate(quad, j);
          if (row >= column && column >= 0)
            entries.emplace_back(static_cast<int>(row), static_cast<int>(column), h(i, j));
        }
    }
    const Eigen::Index free = x_.size() - fixed_;
    newton::Sparse matrix(free, free);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

 private:
  using Matrix4 = Eigen::Matrix4d;
  using Matrix8 = Eigen::Matrix<double, 8, 8>;

  // Among the free ones; negative: fixed.
  Eigen::Index coordinate(const Quad& quad, Eigen::Index i) const {
    return 2 * entry(quad, i / 2).value + i % 2 - fixed_;
  }
  static Eigen::Vector2d at(const Eigen::VectorXd& x, const Quad& quad, std::size_t k) {
    return x.segment<2>(2 * quad[k % 4].value);
  }
  static double determinant(const Eigen::VectorXd& x, const Quad& quad, std::size_t k) {
    const Eigen::Vector2d a = at(x, quad, k + 1) - at(x, quad, k);
    const Eigen::Vector2d b = at(x, quad, k + 3) - at(x, quad, k);
    return a.x() * b.y() - a.y() * b.x();
  }

  // Of a quad's part over the coordinates of its nodes. The measure of a corner is M/chi, M quadratic in the edges a, b and
  // their determinant d. With chi linear in d it is convex in a, b and d together, so that J' F'' J, the first part of its
  // second derivatives over a and b, is positive definite; the rest comes from those of d(a, b) and of chi(d).
  Matrix8 curvature(const Eigen::VectorXd& x, const Quad& quad, double bound, bool convex) const {
    Matrix8 sum = Matrix8::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      const Matrix4 of_edges = corner_curvature(at(x, quad, k + 1) - at(x, quad, k),
                                                at(x, quad, k + 3) - at(x, quad, k), bound, convex);
      const std::array<Eigen::Index, 2> end{node(k + 1), node(k + 3)};
      for (const Eigen::Index i : {0, 1})
        for (const Eigen::Index j : {0, 1}) {
          const Eigen::Matrix2d block = of_edges.block<2, 2>(2 * i, 2 * j);
          sum.block<2, 2>(entry(end, i), entry(end, j)) += block;
          sum.block<2, 2>(entry(end, i), node(k)) -= block;
          sum.block<2, 2>(node(k), entry(end, j)) -= block;
          sum.block<2, 2>(node(k), node(k)) += block;
        }
    }
    return sum / (4.0 * static_cast<double>(quads_.size()));
  }
  static Eigen::Index node(std::size_t k) { return 2 * static_cast<Eigen::Index>(k % 4); }

  Matrix4 corner_curvature(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double bound,
                           bool convex) const {
    const double shape = 1 - size_share_, d = a.x() * b.y() - a.y() * b.x();
    const double root = portable::hypot(bound, d), chi = 0.5 * (d + root);
    const double slope = 0.5 * (1 + d / root);
    const double bend = convex ? 0 : 0.5 * bound * bound / (root * root * root);
    const double f =
        (shape * (a.squaredNorm() + b.squaredNorm()) + size_share_ * (d * d + 1)) / chi;
    const double by_d = (2 * size_share_ * d - f * slope) / chi;
    const double by_dd = (2 * size_share_ - 2 * by_d * slope - f * bend) / chi;
    const double by_ud = -2 * shape * slope / (chi * chi);  // times the edges
    const Eigen::Vector4d u(a.x(), a.y(), b.x(), b.y()), to_d(b.y(), -b.x(), -a.y(), a.x());
    Matrix4 h = by_dd * to_d * to_d.transpose() + by_ud * u * to_d.transpose() +
                by_ud * to_d * u.transpose();
    h.diagonal().array() += 2 * shape / chi;
    if (convex) return h;
    h(0, 3) += by_d, h(3, 0) += by_d;
    h(1, 2) -= by_d, h(2, 1) -= by_d;
    return h;
  }

  double corner(const Eigen::VectorXd& x, const Quad& quad, std::size_t k, double bound,
                Eigen::VectorXd& gradient) const {
    const Eigen::Vector2d a = at(x, quad, k + 1) - at(x, quad, k);
    const Eigen::Vector2d b = at(x, quad, k + 3) - at(x, quad, k);
    const double d = a.x() * b.y() - a.y() * b.x(), root = portable::hypot(bound, d);
    const double chi = 0.5 * (d + root);
    const double f =
        ((1 - size_share_) * (a.squaredNorm() + b.squaredNorm()) + size_share_ * (d * d + 1)) / chi;
    const double by_d = (2 * size_share_ * d - f * 0.5 * (1 + d / root)) / chi;
    const double by_a = 2 * (1 - size_share_) / chi;
    const Eigen::Vector2d to_a = by_a * a + by_d * Eigen::Vector2d(b.y(), -b.x());
    const Eigen::Vector2d to_b = by_a * b + by_d * Eigen::Vector2d(-a.y(), a.x());
    gradient.segment<2>(2 * quad[(k + 1) % 4].value) += to_a;
    gradient.segment<2>(2 * quad[(k + 3) % 4].value) += to_b;
    gradient.segment<2>(2 * quad[k].value) -= to_a + to_b;
    return f;
  }

  const std::vector<Quad>& quads_;
  double size_share_;
  Eigen::Index fixed_;
  Eigen::VectorXd x_;
  double scale_ = 1;
};

void move_nodes(std::vector<Point>& nodes, std::size_t fixed, const Quality& quality,
                const Eigen::VectorXd& to) {
  for (std::size_t i = fixed; i < nodes.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k)
      nodes[i][k] = to[static_cast<Eigen::Index>(2 * i + k)] / quality.scale();
}

}  // namespace

double rough_measure(const std::vector<Point>& nodes, const std::vector<Quad>& quads,
                     std::size_t fixed, double size_share, int iterations) {
  return descend(Quality(nodes, quads, fixed, size_share), iterations).value;
}

void smooth_mesh(std::vector<Point>& nodes, const std::vector<Quad>& quads, std::size_t fixed,
                 double size_share) {
  if (nodes.size() <= fixed) return;
  const Quality quality(nodes, quads, fixed, size_share);
  move_nodes(nodes, fixed, quality, minimise(quality));
}

}  // namespace pulvis
