#include "scenes/lever/mesh/surface_slope.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace pulvis {

SurfaceSlope::SurfaceSlope(const LeverLevel& level)
    : level_(level), elements_of_(level.plan->points.size()) {
  const auto add = [&](const auto& element) {
    for (const int p : element)
      if (level.node[static_cast<std::size_t>(p)] < 0) return;  // a level of the foot ends before
    for (const int p : element)
      elements_of_[static_cast<std::size_t>(p)].push_back(static_cast<int>(elements_.size()));
    elements_.emplace_back(element.begin(), element.end());
  };
  for (const auto& quad : level.plan->quads) add(quad);
  for (const auto& triangle : level.plan->triangles) add(triangle);
}

std::optional<SurfaceSlope::Gauges> SurfaceSlope::at(const Vec2& point) const {
  const auto place = locate(*level_.plan, point);
  if (!place) return {};
  Gauges gauges;
  for (const auto& [p, share] : *place) {
    if (elements_of_[static_cast<std::size_t>(p)].empty()) return {};
    const Patch patch = patch_of(p);
    for (std::size_t i = 0; i < patch.points.size(); ++i) {
      const int node = level_.node[static_cast<std::size_t>(patch.points[i])];
      const Eigen::Vector2d weight = share * patch.weights.col(static_cast<Eigen::Index>(i));
      gauges.along.push_back({node, weight.x()});
      gauges.across.push_back({node, weight.y()});
    }
  }
  return gauges;
}

// The points of all elements that touch one of these.
std::vector<int> SurfaceSlope::grown(const std::vector<int>& points) const {
  std::vector<int> all;
  for (const int p : points)
    for (const int e : elements_of_[static_cast<std::size_t>(p)])
      all.insert(all.end(), elements_[static_cast<std::size_t>(e)].begin(),
                 elements_[static_cast<std::size_t>(e)].end());
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// Grows until its points determine a quadratic, which takes more elements at sides and corners. On a lever of one element
// across there are none that do: the quadratic of least curvature is taken.
SurfaceSlope::Patch SurfaceSlope::patch_of(int point) const {
  constexpr int most_rings = 3, terms = 6;
  const Vec2 origin = level_.plan->points[static_cast<std::size_t>(point)];
  Patch patch{{point}, {}};
  for (int ring = 0; ring < most_rings; ++ring) {
    patch.points = grown(patch.points);
    const auto n = static_cast<Eigen::Index>(patch.points.size());
    Eigen::Matrix2Xd from(2, n);
    for (Eigen::Index i = 0; i < n; ++i)
      from.col(i) =
          level_.plan->points[static_cast<std::size_t>(patch.points[static_cast<std::size_t>(i)])] -
          origin;
    const Eigen::Vector2d size = from.rowwise().lpNorm<Eigen::Infinity>();
    const Eigen::ArrayXd x = from.row(0).transpose() / size.x(),
                         y = from.row(1).transpose() / size.y();
    Eigen::MatrixXd powers(n, terms);
    powers << Eigen::VectorXd::Ones(n), x.matrix(), y.matrix(), (x * x).matrix(), (x * y).matrix(),
        (y * y).matrix();
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> fit;
    fit.setThreshold(1e-6);
    fit.compute(powers);
    if (fit.rank() < terms && ring + 1 < most_rings) continue;
    patch.weights = size.cwiseInverse().asDiagonal() * fit.pseudoInverse().middleRows(1, 2);
    break;
  }
  return patch;
}

}  // namespace pulvis
