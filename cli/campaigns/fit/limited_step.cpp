#include "cli/campaigns/fit/limited_step.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "scenes/solve/least_squares.hpp"

namespace pulvis {
namespace {

constexpr int most_planes = 8, most_halvings = 50;
constexpr double feasible = 1e-9;  // relative to the numbers in the limit

bool is_within(const Eigen::VectorXd& u, const HalfSpace& limit) {
  return limit.normal.dot(u) - limit.end <= feasible * (1 + std::abs(limit.end));
}

// Where the model is stationary while these limits hold as equations; none if they contradict each other.
std::optional<Eigen::VectorXd> stationary(const QuadraticModel& model,
                                          const std::vector<const HalfSpace*>& active) {
  const Eigen::Index n = model.slope.size(), all = n + static_cast<Eigen::Index>(active.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(all, all);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(all);
  system.topLeftCorner(n, n) = model.curvature;
  right.head(n) = -model.slope;
  for (Eigen::Index row = n; row < all; ++row) {
    const HalfSpace& limit = *active[static_cast<std::size_t>(row - n)];
    system.row(row).head(n) = limit.normal.transpose();
    system.col(row).head(n) = limit.normal;
    right[row] = limit.end;
  }
  const Eigen::VectorXd u = shortest_least_squares(system, right).head(n);
  for (const HalfSpace* limit : active)
    if (!is_within(-u, {limit->normal, -limit->end})) return std::nullopt;
  return u;
}

struct Faces {
  const QuadraticModel& model;
  const std::vector<HalfSpace>& limits;
  std::vector<const HalfSpace*> active = {};
  std::optional<Eigen::VectorXd> best = {};

  void try_from(std::size_t first) {
    const auto u = stationary(model, active);
    if (u && std::ranges::all_of(limits, [&](const HalfSpace& l) { return is_within(*u, l); }) &&
        (!best || model.at(*u) < model.at(*best)))
      best = u;
    if (static_cast<Eigen::Index>(active.size()) == model.slope.size()) return;
    for (std::size_t i = first; i < limits.size(); ++i) {
      active.push_back(&limits[i]);
      try_from(i + 1);
      active.pop_back();
    }
  }
};

// The last allowed point between the inside and `beyond`, which is not.
Eigen::VectorXd border_towards(const Region& region, Eigen::VectorXd beyond) {
  Eigen::VectorXd last = region.inside;
  for (int halving = 0; halving < most_halvings; ++halving) {
    if ((beyond - last).norm() <= 0.01 * region.accuracy) break;
    const Eigen::VectorXd middle = (last + beyond) / 2;
    (region.allows(middle) ? last : beyond) = middle;
  }
  return last;
}

// The plane through the border at `at`, on the way to `beyond`: normal to the direction in which the points of the border
// around it differ least.
HalfSpace border_plane(const Region& region, const Eigen::VectorXd& at,
                       const Eigen::VectorXd& beyond) {
  const Eigen::Index n = at.size();
  const Eigen::VectorXd way = beyond - region.inside;
  Eigen::MatrixXd differences = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (const double aside : {0.1, -0.1}) {
      const Eigen::VectorXd far =
          region.inside + 2 * (way + aside * way.norm() * Eigen::VectorXd::Unit(n, k));
      if (region.allows(far)) continue;
      differences.row(k) = (border_towards(region, far) - at).transpose();
      break;
    }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(differences, Eigen::ComputeFullV);
  Eigen::VectorXd normal = svd.matrixV().col(n - 1);
  if (normal.dot(way) < 0) normal = -normal;
  return {normal, normal.dot(at)};
}

}  // namespace

std::optional<Eigen::VectorXd> minimum_within(const QuadraticModel& model,
                                              const std::vector<HalfSpace>& limits) {
  Faces faces{model, limits};
  faces.try_from(0);
  return faces.best;
}

LimitedStep limited_step(const QuadraticModel& model, std::vector<HalfSpace> limits,
                         const Region& region) {
  LimitedStep step{region.inside, false, false};
  for (int planes = 0; planes <= most_planes; ++planes) {
    const auto minimum = minimum_within(model, limits);
    if (!minimum) break;
    if (region.allows(*minimum)) return {*minimum, true, planes > 0};
    const Eigen::VectorXd border = border_towards(region, *minimum);
    step = {border, (border - *minimum).norm() <= region.accuracy, true};
    if (step.is_best) break;
    limits.push_back(border_plane(region, border, *minimum));
  }
  return step;
}

}  // namespace pulvis
