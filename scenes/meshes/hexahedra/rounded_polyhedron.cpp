#include "scenes/meshes/hexahedra/rounded_polyhedron.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "scenes/meshes/hexahedra/convex_hull.hpp"
#include "scenes/meshes/hexahedra/triangle.hpp"

namespace pulvis::space {
namespace {

using std::numbers::pi;

struct Side {  // a face of the smaller polyhedron
  HalfSpace plane;
  std::vector<Vec3> corners;  // counter-clockwise as seen from outside
};

bool lies_in(const HalfSpace& plane, const Vec3& p, double near) {
  return std::abs(plane.normal.dot(p) - plane.offset) < near;
}

void sort_around(const Vec3& normal, std::vector<Vec3>& corners) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : corners) middle += p / static_cast<double>(corners.size());
  const Vec3 x = (corners[0] - middle).normalized(), y = normal.cross(x);
  std::ranges::sort(corners, {}, [&](const Vec3& p) {
    return portable::atan2((p - middle).dot(y), (p - middle).dot(x));
  });
}

// Of the smaller polyhedron, whose faces lie `rounding` deeper.
std::vector<HalfSpace> moved_in(std::vector<HalfSpace> planes, double rounding) {
  for (HalfSpace& plane : planes) plane.offset -= rounding;
  return planes;
}
bool encloses_volume(const std::vector<Vec3>& corners) { return corners.size() >= 4; }

class RoundedPolyhedron final : public StarSurface {
 public:
  explicit RoundedPolyhedron(const PolyhedronShape& shape) : rounding_(shape.rounding) {
    const std::vector<HalfSpace> planes = moved_in(faces_of_hull(shape.corners), rounding_);
    const std::vector<Vec3> corners = corners_between(planes);
    if (!encloses_volume(corners))
      throw std::invalid_argument("nothing is left of it after rounding");
    for (const HalfSpace& plane : planes) add_side(plane, corners);
    measure(corners);
    move_to_centre();
  }

  double radius(const Vec3& d) const override {
    double t = 0;
    const Side& side = first_side(d, t);
    if (rounding_ == 0) return t;
    // Straight over a flat face, or on the rounding beyond it: the distance to the smaller polyhedron is convex along the
    // ray, so Newton's steps approach from outside.
    for (int i = 0; i < 60; ++i) {
      const Vec3 off = t * d - closest(t * d);
      const double distance = off.norm();
      const double slope = distance > 0 ? off.dot(d) / distance : side.plane.normal.dot(d);
      const double step = (distance - rounding_) / slope;
      t -= step;
      if (step < 1e-14 * t) break;
    }
    return t;
  }
  Vec3 normal(const Vec3& d) const override { return spot(d).normal; }
  Spot spot(const Vec3& d) const override {
    double t = 0;
    const Side& side = first_side(d, t);
    if (rounding_ == 0) return {t, side.plane.normal};
    const double r = radius(d);
    const Vec3 p = r * d;
    return {r, (p - closest(p)).normalized()};
  }
  Vec3 half_size() const override { return half_size_; }
  double volume() const override { return volume_; }
  const Vec3& centre() const { return centre_; }

 private:
  void add_side(const HalfSpace& plane, const std::vector<Vec3>& corners) {
    double size = 0;
    for (const Vec3& p : corners) size = std::max(size, (p - corners[0]).norm());
    Side side{plane, {}};
    for (const Vec3& p : corners)
      if (lies_in(plane, p, 1e-7 * size)) side.corners.push_back(p);
    if (side.corners.size() < 3) return;
    sort_around(plane.normal, side.corners);
    for (std::size_t i = 1; i + 1 < side.corners.size(); ++i)
      triangles_.push_back({side.corners[0], side.corners[i], side.corners[i + 1]});
    sides_.push_back(std::move(side));
  }

  // Steiner's formula for the volume and, term by term, for the first moment: the smaller polyhedron, prisms on its
  // faces, wedges along its edges, and sphere sectors at its corners, whose solid angles are the angular defects. (The
  // moments of the sectors about their corners cancel: together they form a sphere.)
  void measure(const std::vector<Vec3>& corners) {
    const double w = rounding_, sector = w * w * w / 3;
    Vec3 moment = Vec3::Zero();
    volume_ = 4 * pi * sector;
    for (const Vec3& p : corners) moment += 2 * pi * sector * p;
    for (const Triangle& t : triangles_) {
      const Vec3 normal = area_vector(t), sum = t[0] + t[1] + t[2];
      const double inner = normal.dot(t[0]) / 6, outer = w * normal.norm() / 2;
      volume_ += inner + outer;
      moment += inner * sum / 4 + outer * sum / 3 + w * outer / 2 * normal.normalized();
    }
    for (const Side& side : sides_) add_edges(side, moment);
    centre_ = moment / volume_;
  }
  // A wedge of angle theta about an edge; each of its two sides adds half.
  void add_edges(const Side& side, Vec3& moment) {
    const double w = rounding_;
    const std::size_t n = side.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 &before = side.corners[(k + n - 1) % n], &from = side.corners[k],
                 &to = side.corners[(k + 1) % n];
      const double length = (to - from).norm(), theta = angle_at(side, from, to);
      const Vec3 across = (to - from).cross(side.plane.normal) / length;
      // Half of the wedge: from this side's normal by theta/2 towards `across`.
      const Vec3 arc =
          portable::sin(theta / 2) * side.plane.normal + (1 - portable::cos(theta / 2)) * across;
      const double half = length * theta * w * w / 4;
      volume_ += half;
      moment += half * (from + to) / 2 + length * w * w * w / 3 * arc;
      moment -= w * w * w / 3 * inner_angle(before - from, to - from) * from;
    }
  }
  static double inner_angle(const Vec3& a, const Vec3& b) {
    return portable::atan2(a.cross(b).norm(), a.dot(b));
  }
  double angle_at(const Side& side, const Vec3& from, const Vec3& to) const {
    const double near = 1e-7 * (to - from).norm();
    for (const Side& other : sides_)
      if (&other != &side && lies_in(other.plane, from, near) && lies_in(other.plane, to, near))
        return inner_angle(side.plane.normal, other.plane.normal);
    return 0;
  }

  void move_to_centre() {
    Vec3 low = sides_[0].corners[0] - centre_, high = low;
    for (Side& side : sides_) {
      side.plane.offset -= side.plane.normal.dot(centre_);
      for (Vec3& p : side.corners) {
        p -= centre_;
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    for (Triangle& t : triangles_) {
      for (Vec3& p : t) p -= centre_;
      near_.emplace_back(t);
    }
    half_size_ = (high - low) / 2 + Vec3::Constant(rounding_);
  }

  // The side through which a ray leaves the sharp polyhedron, at t d.
  const Side& first_side(const Vec3& d, double& t) const {
    const Side* first = nullptr;
    for (const Side& side : sides_) {
      const double towards = side.plane.normal.dot(d);
      if (towards <= 0) continue;
      const double at = (side.plane.offset + rounding_) / towards;
      if (first && at >= t) continue;
      t = at;
      first = &side;
    }
    return *first;
  }
  Vec3 closest(const Vec3& p) const {
    Vec3 best = Vec3::Zero();
    double least = std::numeric_limits<double>::max();
    for (const NearTriangle& t : near_) {
      if (!t.is_before(p)) continue;
      const Vec3 near = t.closest(p);
      if ((near - p).squaredNorm() >= least) continue;
      least = (near - p).squaredNorm();
      best = near;
    }
    return least < std::numeric_limits<double>::max() ? best : p;
  }

  double rounding_, volume_ = 0;
  std::vector<Side> sides_;
  std::vector<Triangle> triangles_;
  std::vector<NearTriangle> near_;  // the same
  Vec3 half_size_ = Vec3::Zero(), centre_ = Vec3::Zero();
};

}  // namespace

std::unique_ptr<StarSurface> polyhedron_surface(const PolyhedronShape& shape) {
  return std::make_unique<RoundedPolyhedron>(shape);
}

std::optional<double> too_round(const PolyhedronShape& shape) {
  const std::vector<HalfSpace> planes = faces_of_hull(shape.corners);
  const auto is_left = [&](double rounding) {
    return encloses_volume(corners_between(moved_in(planes, rounding)));
  };
  if (is_left(shape.rounding)) return std::nullopt;
  double low = 0, high = shape.rounding;
  constexpr int halvings = 50;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (is_left(middle) ? low : high) = middle;
  }
  return low;
}

Vec3 centre_of(const PolyhedronShape& shape) { return RoundedPolyhedron(shape).centre(); }

}  // namespace pulvis::space
