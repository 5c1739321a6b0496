#include "scenes/packing/solids/widths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scenes/packing/solids/rigid_shape.hpp"

namespace pulvis::space {
namespace {

constexpr int grid = 16;         // directions along an edge of a cube of directions
constexpr int tries = 6;         // number of narrowest directions that are refined
constexpr double finest = 1e-7;  // rad, where a search ends
constexpr double clearly =
    1 - 1e-6;  // clearly narrower than along one of its axes, not just by round-off

struct Width {
  V3 along;
  double size;
};

class WidthSearch {
 public:
  explicit WidthSearch(const RigidShape& shape) : shape_(shape) {}

  Width least() const {
    std::vector<Width> found;
    for (int side = 0; side < 3; ++side)  // the other three are opposite directions
      for (int i = 0; i <= grid; ++i)
        for (int k = 0; k <= grid; ++k) {
          const double u = 2.0 * i / grid - 1, v = 2.0 * k / grid - 1;
          found.push_back(along(side == 0 ? V3{1, u, v} : side == 1 ? V3{v, 1, u} : V3{u, v, 1}));
        }
    std::ranges::stable_sort(found, {}, &Width::size);
    Width best = along({1, 0, 0});
    for (const V3& axis : {V3{0, 1, 0}, V3{0, 0, 1}}) best = narrower(best, along(axis));
    const Width of_axes = best;
    for (int t = 0; t < tries; ++t)
      best = narrower(best, followed(found[static_cast<std::size_t>(t)], frame));
    return best.size < clearly * of_axes.size ? best : of_axes;
  }

  Width least_across(const V3& n) const {
    const auto [a, b] = frame(n);
    constexpr int steps = 8 * grid;
    Width best = along(a);
    for (int i = 1; i < 2 * steps; ++i) {  // half a turn, more densely near its ends
      const double share = static_cast<double>(i) / steps - 1;
      best = narrower(best, along((1 - std::abs(share)) * b + share * a));
    }
    best = followed(best, [&](const V3& m) { return Frame{cross(n, m), V3{}}; });
    Width of_axes = best;
    for (const V3& axis : {V3{1, 0, 0}, V3{0, 1, 0}, V3{0, 0, 1}})
      if (std::abs(dot(axis, n)) < finest) of_axes = narrower(of_axes, along(axis));
    return best.size < clearly * of_axes.size ? best : of_axes;
  }

 private:
  using Frame = std::array<V3, 2>;

  Width along(const V3& direction) const {
    const V3 n = unit(direction);
    return {n, dot(shape_.support(n) - shape_.support(-n), n)};
  }
  static Width narrower(const Width& a, const Width& b) { return b.size < a.size ? b : a; }

  static Frame frame(const V3& n) {
    const V3 off = std::abs(n.x) < 0.6 ? V3{1, 0, 0} : V3{0, 1, 0};
    const V3 a = unit(cross(n, off));
    return {a, cross(n, a)};
  }

  // Descent in ever smaller steps along the two vectors perpendicular to it and between them.
  template <class Across>
  Width followed(Width best, const Across& across) const {
    for (double step = 2.0 / grid; step > finest; step /= 2)
      for (bool better = true; better;) {
        const Width from = best;
        const Frame sides = across(from.along);
        for (int i = -1; i <= 1; ++i)
          for (int k = -1; k <= 1; ++k)
            best = narrower(best, along(from.along + step * (i * sides[0] + k * sides[1])));
        better = best.size < (1 - 1e-12) * from.size;
      }
    return best;
  }

  const RigidShape& shape_;
};

}  // namespace

Widths widths_of(const ParticleShape& shape) {
  const RigidShape rigid = rigid_shape(shape, 1);
  if (rigid.is_ball()) return {2 * rigid.radius, 2 * rigid.radius};
  const WidthSearch search(rigid);
  const Width least = search.least();
  return {least.size, search.least_across(least.along).size};
}

}  // namespace pulvis::space
