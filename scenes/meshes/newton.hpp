// Minimises a mesh quality measure to round-off; folded elements are unfolded where possible.
//
// Source: Nocedal & Wright, 3.3 and 3.4: Newton's method with a line search. Where the second derivatives are not positive
// definite, far from the minimum, their convex part takes their place (Garanzha et al. 2021, see descent.hpp).
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>

#include "scenes/meshes/descent.hpp"

namespace pulvis {

namespace newton {

using Sparse = Eigen::SparseMatrix<double>;

inline constexpr int max_iterations = 300, iterations_between_bounds = 4;
// Of the mean edge. Steps shrink quadratically: the one after this would be below round-off.
inline constexpr double last_step = 1e-9;
inline constexpr double round_off = 1e-13;  // relative, of the measure
inline constexpr double any_length = 1e300;
inline constexpr double least_folded = 1e-3;  // bound below which elements are not going to unfold

class Direction {
 public:
  // For free coordinates; the others come first and stay.
  template <class Quality>
  Eigen::VectorXd operator()(const Quality& quality, double bound, const Descent& state) {
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(state.x.size());
    for (const bool convex : {false, true}) {
      const Sparse curvature = quality.curvature(state.x, bound, convex);
      if (!analysed_) factors_.analyzePattern(curvature);
      analysed_ = true;
      factors_.factorize(curvature);
      if (factors_.info() != Eigen::Success) continue;
      direction.tail(curvature.rows()) = -factors_.solve(state.gradient.tail(curvature.rows()));
      break;
    }
    return direction;
  }

 private:
  Eigen::SimplicialLLT<Sparse> factors_;
  bool analysed_ = false;
};

}  // namespace newton

// Quality as for descend(), and curvature(x, bound, convex).
template <class Quality>
Eigen::VectorXd minimise(const Quality& quality) {
  using namespace newton;
  Descent state{quality.start(), {}, 0};
  double bound = descent::bound_for(quality.min_determinant(state.x));
  state.value = quality.value(state.x, bound, state.gradient);
  Direction direction_of;
  for (int i = 1; i <= max_iterations; ++i) {
    const Eigen::VectorXd direction = direction_of(quality, bound, state);
    const bool still = !descent::advance(quality, bound, direction, any_length, state, round_off) ||
                       quality.longest_move(direction) < last_step;
    const bool folded = bound > descent::min_bound;
    if (still && (!folded || bound < least_folded)) break;
    if (!folded || !(still || i % iterations_between_bounds == 0)) continue;
    const double next = descent::bound_for(quality.min_determinant(state.x));
    bound = still ? std::min(next, bound / 2) : std::min(next, bound);
    state.value = quality.value(state.x, bound, state.gradient);
  }
  return state.x;
}

}  // namespace pulvis
