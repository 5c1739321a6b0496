#include "scenes/meshes/hexahedra/smooth_hexahedra.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/portable_math.hpp"
#include "scenes/meshes/descent.hpp"

namespace pulvis::space {
namespace {

// The corners at the ends of a corner's edges, right-handed.
constexpr int corner_edges[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                    {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
const double cube_norm = 3 * std::sqrt(3.0);

using Edges = std::array<Vec3, 3>;

class HexahedraQuality {
 public:
  HexahedraQuality(const std::vector<Vec3>& nodes, const std::vector<Hexahedron>& hexahedra,
                   int fixed, double size_share)
      : hexahedra_(hexahedra),
        fixed_(3 * static_cast<Eigen::Index>(fixed)),
        size_share_(size_share),
        x_(3 * static_cast<Eigen::Index>(nodes.size())) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      x_.segment<3>(3 * static_cast<Eigen::Index>(i)) = nodes[i];
    double volume = 0;
    for (const Hexahedron& h : hexahedra)
      for (int c = 0; c < 8; ++c) volume += product(edges(x_, h, c)) / 8;
    scale_ = portable::cbrt(static_cast<double>(hexahedra.size()) / volume);
    x_ *= scale_;
  }

  const Eigen::VectorXd& start() const { return x_; }
  double scale() const { return scale_; }
  static double longest_move(const Eigen::VectorXd& direction) {
    return direction.cwiseAbs().maxCoeff();
  }

  double min_determinant(const Eigen::VectorXd& x) const {
    double minimum = std::numeric_limits<double>::max();
    for (const Hexahedron& h : hexahedra_)
      for (int c = 0; c < 8; ++c) minimum = std::min(minimum, product(edges(x, h, c)));
    return minimum;
  }

  double value(const Eigen::VectorXd& x, double bound, Eigen::VectorXd& gradient) const {
    gradient.setZero(x.size());
    double sum = 0;
    for (const Hexahedron& h : hexahedra_)
      for (int c = 0; c < 8; ++c) sum += corner(x, h, c, bound, gradient);
    const double share = 1 / (8.0 * static_cast<double>(hexahedra_.size()));
    gradient *= share;
    gradient.head(fixed_).setZero();
    return share * sum;
  }

 private:
  static Eigen::Index place(const Hexahedron& h, int corner) {
    return 3 * static_cast<Eigen::Index>(entry(h, corner).value);
  }
  static Edges edges(const Eigen::VectorXd& x, const Hexahedron& h, int corner) {
    Edges e;
    for (int k = 0; k < 3; ++k)
      entry(e, k) = x.segment<3>(place(h, entry(entry(corner_edges, corner), k))) -
                    x.segment<3>(place(h, corner));
    return e;
  }
  static double product(const Edges& e) { return e[0].dot(e[1].cross(e[2])); }

  double corner(const Eigen::VectorXd& x, const Hexahedron& h, int c, double bound,
                Eigen::VectorXd& gradient) const {
    const Edges e = edges(x, h, c);
    const double d = product(e), root = portable::hypot(bound, d), chi = 0.5 * (d + root);
    const double square = e[0].squaredNorm() + e[1].squaredNorm() + e[2].squaredNorm();
    const double shape = (1 - size_share_) / cube_norm * std::sqrt(square);
    const double f = (shape * square + 0.5 * size_share_ * (d * d + 1)) / chi;
    const double by_edge = 3 * shape / chi;
    const double by_d = (size_share_ * d - f * 0.5 * (1 + d / root)) / chi;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 force = by_edge * e[k] + by_d * e[(k + 1) % 3].cross(e[(k + 2) % 3]);
      gradient.segment<3>(place(h, entry(entry(corner_edges, c), k))) += force;
      gradient.segment<3>(place(h, c)) -= force;
    }
    return f;
  }

  const std::vector<Hexahedron>& hexahedra_;
  Eigen::Index fixed_;
  double size_share_;
  Eigen::VectorXd x_;
  double scale_ = 1;
};

}  // namespace

double smooth_hexahedra(std::vector<Vec3>& nodes, const std::vector<Hexahedron>& hexahedra,
                        int fixed, const Smoothing& how) {
  const HexahedraQuality quality(nodes, hexahedra, fixed, how.size_share);
  const Descent state = descend(quality, how.max_iterations);
  for (std::size_t i = static_cast<std::size_t>(fixed); i < nodes.size(); ++i)
    nodes[i] = state.x.segment<3>(3 * static_cast<Eigen::Index>(i)) / quality.scale();
  return state.value;
}

double least_corner(const std::vector<Vec3>& nodes, const std::vector<Hexahedron>& hexahedra) {
  const HexahedraQuality quality(nodes, hexahedra, 0, 0);
  return quality.min_determinant(quality.start()) /
         (quality.scale() * quality.scale() * quality.scale());
}

}  // namespace pulvis::space
