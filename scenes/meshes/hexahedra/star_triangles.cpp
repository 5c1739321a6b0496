#include "scenes/meshes/hexahedra/star_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "engine/entry.hpp"
#include "engine/portable_math.hpp"
#include "scenes/meshes/hexahedra/directions.hpp"
#include "scenes/meshes/hexahedra/stl.hpp"

namespace pulvis::space {
namespace {

using std::numbers::pi;

// Triangles sorted into the cells of a cube around the centre through which they are seen.
class TriangleFan {
 public:
  explicit TriangleFan(const std::vector<Triangle>& triangles) {
    // A smoothed surface sends a hundred rays for each of its points: cells with few triangles pay off.
    cells_ = std::clamp(static_cast<int>(2 * std::sqrt(static_cast<double>(triangles.size()) / 6)),
                        8, 40);
    in_cell_.resize(static_cast<std::size_t>(6 * cells_ * cells_));
    const std::vector<Vec3> middles = cell_middles();
    for (const Triangle& t : triangles) add(t, middles);
  }

  struct Hit {
    double distance;
    Vec3 normal;  // not normalised
  };
  // The surface is closed around the centre: take the triangle that contains the ray best.
  Hit along(const Vec3& d) const {
    double best = -std::numeric_limits<double>::max();
    Hit hit{};
    for (const int t : entry(in_cell_, cell_of(d))) {
      const Seen& triangle = entry(seen_, t);
      const double all = triangle.normal.dot(d);
      if (all <= 0) continue;
      const double inside = triangle.least_share(d) / all;
      if (inside <= best) continue;
      best = inside;
      hit = {triangle.plane / all, triangle.normal};
    }
    return hit;
  }

 private:
  // A triangle, with the data needed for rays from the centre.
  struct Seen {
    Vec3 normal;                // area_vector
    std::array<Vec3, 3> sides;  // normals of the planes through the centre and each side
    double plane;               // normal . x on the triangle

    explicit Seen(const Triangle& t)
        : normal(area_vector(t)),
          sides{t[0].cross(t[1]), t[1].cross(t[2]), t[2].cross(t[0])},
          plane(normal.dot(t[0])) {}
    // The smallest barycentric coordinate of the point where the ray hits, times normal . d.
    double least_share(const Vec3& d) const {
      return std::min({sides[0].dot(d), sides[1].dot(d), sides[2].dot(d)});
    }
  };

  int cell_of(const Vec3& d) const {
    Eigen::Index axis = 0;
    const double largest = d.cwiseAbs().maxCoeff(&axis);
    const auto along = [&](Eigen::Index i) {
      const double share = (d[i % 3] / largest + 1) / 2;
      return std::clamp(static_cast<int>(share * cells_), 0, cells_ - 1);
    };
    const int side = static_cast<int>(2 * axis) + (d[axis] > 0 ? 1 : 0);
    return (side * cells_ + along(axis + 1)) * cells_ + along(axis + 2);
  }

  // To all cells whose cap around their centre intersects the triangle's, and lies on the inner side of the planes through
  // the centre and its sides, at least in part.
  void add(const Triangle& triangle, const std::vector<Vec3>& middles) {
    const int number = static_cast<int>(seen_.size());
    seen_.emplace_back(triangle);
    const Vec3 middle =
        (triangle[0].normalized() + triangle[1].normalized() + triangle[2].normalized())
            .normalized();
    const double of_cell = portable::atan(std::numbers::sqrt2 / cells_) + 1e-6,
                 least_inside = -portable::sin(of_cell);
    std::array<Vec3, 3> inwards = seen_.back().sides;
    for (Vec3& side : inwards) side.normalize();
    double far = 0;
    for (const Vec3& p : triangle)
      far = std::max(far, portable::atan2(middle.cross(p).norm(), middle.dot(p)));
    const double least = portable::cos(std::min(of_cell + far, pi));
    for (std::size_t c = 0; c < middles.size(); ++c) {
      if (middle.dot(middles[c]) < least) continue;
      if (std::ranges::all_of(
              inwards, [&](const Vec3& side) { return side.dot(middles[c]) >= least_inside; }))
        in_cell_[c].push_back(number);
    }
  }

  std::vector<Vec3> cell_middles() const {
    std::vector<Vec3> middles;
    for (int side = 0; side < 6; ++side)
      for (int a = 0; a < cells_; ++a)
        for (int b = 0; b < cells_; ++b) {
          Vec3 d;
          d[side / 2] = side % 2 == 1 ? 1 : -1;
          d[(side / 2 + 1) % 3] = (2 * a + 1.0) / cells_ - 1;
          d[(side / 2 + 2) % 3] = (2 * b + 1.0) / cells_ - 1;
          middles.push_back(d.normalized());
        }
    return middles;
  }

  std::vector<Seen> seen_;
  int cells_ = 1;
  std::vector<std::vector<int>> in_cell_;
};

// Rays in rings around a direction: their offsets in the two directions across it, with bell-shaped weights.
struct RingRay {
  double out, weight, cosine, sine;
};
std::vector<RingRay> rays_in_rings() {
  constexpr int rings = 3, rays = 8;
  std::vector<RingRay> all;
  for (int ring = 1; ring <= rings; ++ring) {
    const double out = static_cast<double>(ring) / rings,
                 weight = ring * (1 - out * out + 0.05) / rays;
    for (int k = 0; k < rays; ++k) {
      const double turn = 2 * pi * (k + 0.5 * (ring % 2)) / rays;
      all.push_back({out, weight, portable::cos(turn), portable::sin(turn)});
    }
  }
  return all;
}

// Two unit vectors perpendicular to a unit vector.
std::array<Vec3, 2> across(const Vec3& d) {
  Eigen::Index least = 0;
  d.cwiseAbs().minCoeff(&least);
  const Vec3 x = Vec3::Unit(least).cross(d).normalized();
  return {x, d.cross(x)};
}

constexpr int volume_cells = 16;  // along a quarter circle: volume of the smoothed shape, to 1e-4

class TriangleSurface final : public StarSurface {
 public:
  TriangleSurface(std::vector<Triangle> triangles, double smoothing)
      : smoothing_(smoothing), fan_(triangles), volume_(volume_of(triangles)) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
    for (const Triangle& t : triangles)
      for (const Vec3& p : t) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    half_size_ = (high - low) / 2;
    if (smoothing_ > 0) volume_ = volume_about(*this, volume_cells);
  }

  void scale(double factor) {
    scale_ *= factor;
    volume_ *= factor * factor * factor;
    half_size_ *= factor;
  }

  // Smoothed: the mean over rays around the direction.
  double radius(const Vec3& d) const override {
    if (smoothing_ == 0) return scale_ * fan_.along(d).distance;
    static const std::vector<RingRay> rays = rays_in_rings();
    const std::array<Vec3, 2> side = across(d);
    double sum = fan_.along(d).distance / 2, weights = 0.5;
    for (const RingRay& ray : rays) {
      const Vec3 off = ray.cosine * side[0] + ray.sine * side[1];
      sum += ray.weight * fan_.along((d + smoothing_ * ray.out * off).normalized()).distance;
      weights += ray.weight;
    }
    return scale_ * sum / weights;
  }
  // For the surface r(d) d: along d - grad r / r.
  Vec3 normal(const Vec3& d) const override { return spot(d).normal; }
  Spot spot(const Vec3& d) const override {
    if (smoothing_ == 0) {
      const TriangleFan::Hit hit = fan_.along(d);
      return {scale_ * hit.distance, hit.normal.normalized()};
    }
    const double step = smoothing_ / 2, r = radius(d);
    Vec3 n = d;
    for (const Vec3& side : across(d))
      n -= (radius((d + step * side).normalized()) - radius((d - step * side).normalized())) /
           (2 * step * r) * side;
    return {r, n.normalized()};
  }
  Vec3 half_size() const override { return half_size_; }
  double volume() const override { return volume_; }

 private:
  double smoothing_, scale_ = 1;
  TriangleFan fan_;
  double volume_;
  Vec3 half_size_;
};

}  // namespace

std::unique_ptr<StarSurface> triangle_surface(const StlShape& shape) {
  if (shape.triangles.empty()) throw std::invalid_argument("an STL shape whose file was not read");
  if (const auto why = why_not_star_shaped(shape.triangles)) throw std::invalid_argument(*why);
  const Vec3 centre = centre_of_volume(shape.triangles);
  std::vector<Triangle> triangles = shape.triangles;
  for (Triangle& t : triangles)
    for (Vec3& p : t) p -= centre;
  auto surface = std::make_unique<TriangleSurface>(std::move(triangles), shape.smoothing);
  if (shape.diameter) surface->scale(*shape.diameter * portable::cbrt(pi / 6 / surface->volume()));
  return surface;
}

}  // namespace pulvis::space
