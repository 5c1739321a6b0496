#include "scenes/meshes/hexahedra/mesh_axes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/portable_math.hpp"
#include "scenes/meshes/hexahedra/cubed_sphere.hpp"
#include "scenes/meshes/hexahedra/directions.hpp"

namespace pulvis::space {
namespace {

constexpr int point_cells = 12;    // of `directions`, to determine extents
constexpr int rotations = 2400;    // of which 1/24 are tried: the cube has 24 rotations onto itself
constexpr int most_divisions = 6;  // of the meshes compared: finer ones have the same best axes
constexpr double clearly = 0.9;    // of the gap between the surface and a mesh along its own axes
constexpr std::size_t followed = 3;
constexpr double first_step = 0.16, last_step = 0.004;  // rad, approximate

// Uniformly distributed (Alexa, Super-Fibonacci spirals, CVPR 2022).
Rotation spread_rotation(int i) {
  constexpr double phi = std::numbers::sqrt2, psi = 1.533751168755204288118041;
  const double s = i + 0.5, share = s / rotations;
  const double a = 2 * std::numbers::pi * s / phi, b = 2 * std::numbers::pi * s / psi;
  const double r = std::sqrt(share), rest = std::sqrt(1 - share);
  return {rest * portable::cos(b), r * portable::sin(a), r * portable::cos(a),
          rest * portable::sin(b)};
}

// Whether no rotation of the cube onto itself leaves a rotation with a smaller angle.
bool is_smallest(const Rotation& q) {
  const Vec3 by = q.vec().cwiseAbs();
  const double w = std::abs(q.w());
  return by.maxCoeff() <= (std::numbers::sqrt2 - 1) * w && by.sum() <= w;
}

struct Turned {
  Rotation axes;
  double size;  // m^3, to be minimised
};

class AxesSearch {
 public:
  AxesSearch(const StarSurface& surface, int divisions)
      : surface_(surface), grid_({divisions, divisions, divisions}, 1), quads_(grid_.quads()) {
    for (const Direction& d : directions(point_cells)) points_.push_back(surface.point(d.unit));
  }

  TurnedSurface of_least_box() const {
    return surface(least([&](const Rotation& axes) { return surface(axes).half_size().prod(); }));
  }
  TurnedSurface of_least_gap() const {
    return surface(least([&](const Rotation& axes) { return gap(surface(axes)); }));
  }

  // m^3, approximate: between the surface and the quads over nodes on it.
  double gap(const StarSurface& surface) const {
    std::vector<Vec3> nodes;
    for (const Lattice& at : grid_.rim()) {
      const std::array<double, 3> on_cube = grid_.on_cube(at);
      nodes.push_back(surface.point(surface.direction_of({on_cube[0], on_cube[1], on_cube[2]})));
    }
    double gap = 0;
    for (const auto& quad : quads_) {
      const Vec3 &a = entry(nodes, quad[0]), &b = entry(nodes, quad[1]), &c = entry(nodes, quad[2]),
                 &d = entry(nodes, quad[3]);
      const Vec3 middle = (a + b + c + d) / 4, area = (c - a).cross(d - b) / 2;
      const double far = surface.radius(middle.normalized()) / middle.norm();
      gap += std::abs((far * far * far - 1) * middle.dot(area)) / 3;
    }
    return gap;
  }

 private:
  TurnedSurface surface(const Rotation& axes) const { return {surface_, axes, points_}; }

  template <class Size>
  Rotation least(const Size& size) const {
    std::vector<Turned> found;
    for (int i = 0; i < rotations; ++i)
      if (const Rotation q = spread_rotation(i); is_smallest(q)) found.push_back({q, size(q)});
    std::ranges::stable_sort(found, {}, &Turned::size);
    for (std::size_t i = 0; i < followed; ++i) found[i] = down_from(found[i], size);
    return std::ranges::min_element(found, {}, &Turned::size)->axes;
  }

  template <class Size>
  static Turned down_from(Turned best, const Size& size) {
    for (double step = first_step; step > last_step; step /= 2)
      for (bool better = true; better;) {
        const Turned from = best;
        for (int k = 0; k < 6; ++k) {
          Rotation by(1, 0, 0, 0);
          by.vec()[k / 2] = (k % 2 == 0 ? step : -step) / 2;
          const Rotation axes = (by * from.axes).normalized();
          if (const double here = size(axes); here < best.size) best = {axes, here};
        }
        better = best.size < (1 - 1e-6) * from.size;
      }
    return best;
  }

  const StarSurface& surface_;
  CubedSphere grid_;
  std::vector<std::array<int, 4>> quads_;
  std::vector<Vec3> points_;
};

}  // namespace

TurnedSurface::TurnedSurface(const StarSurface& surface, const Rotation& axes,
                             const std::vector<Vec3>& points)
    : surface_(surface), axes_(axes.toRotationMatrix()) {
  Vec3 low = axes_.transpose() * points[0], high = low;
  for (const Vec3& p : points) {
    const Vec3 seen = axes_.transpose() * p;
    low = low.cwiseMin(seen);
    high = high.cwiseMax(seen);
  }
  half_size_ = (high - low) / 2;
}

std::vector<TurnedSurface> turned_to_fit(const StarSurface& surface, int divisions) {
  const AxesSearch search(surface, std::min(divisions, most_divisions));
  std::vector<TurnedSurface> views{search.of_least_box()};
  if (const TurnedSurface seen = search.of_least_gap();
      search.gap(seen) < clearly * search.gap(surface))
    views.push_back(seen);
  return views;
}

}  // namespace pulvis::space
