#include "scenes/meshes/smooth_mesh.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/portable_math.hpp"
#include "scenes/meshes/descent.hpp"

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

 private:
  static Eigen::Vector2d at(const Eigen::VectorXd& x, const Quad& quad, std::size_t k) {
    return x.segment<2>(2 * quad[k % 4].value);
  }
  static double determinant(const Eigen::VectorXd& x, const Quad& quad, std::size_t k) {
    const Eigen::Vector2d a = at(x, quad, k + 1) - at(x, quad, k);
    const Eigen::Vector2d b = at(x, quad, k + 3) - at(x, quad, k);
    return a.x() * b.y() - a.y() * b.x();
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

}  // namespace

double smooth_mesh(std::vector<Point>& nodes, const std::vector<Quad>& quads, std::size_t fixed,
                   double size_share, int max_iterations) {
  const Quality quality(nodes, quads, fixed, size_share);
  const Descent state = descend(quality, max_iterations);
  for (std::size_t i = fixed; i < nodes.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k)
      nodes[i][k] = state.x[static_cast<Eigen::Index>(2 * i + k)] / quality.scale();
  return state.value;
}

}  // namespace pulvis
