#include "scenes/packing/solids/rigid_shape.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "engine/portable_math.hpp"
#include "engine/result_cache.hpp"
#include "scenes/meshes/hexahedra/convex_hull.hpp"
#include "scenes/meshes/hexahedra/mesh.hpp"
#include "scenes/meshes/hexahedra/rounded_polyhedron.hpp"
#include "scenes/meshes/hexahedra/star_surface.hpp"
#include "scenes/meshes/hexahedra/stl.hpp"
#include "scenes/meshes/hexahedra/triangle.hpp"
#include "scenes/packing/solids/rigid_contact.hpp"

namespace pulvis::space {
namespace {

constexpr int samples = 24;  // for an STL shape, along an edge of a cube of directions
constexpr std::size_t most_corners = 4000;

V3 ellipsoid_support(const V3& half, const V3& n) {
  const V3 scaled_normal{half.x * n.x, half.y * n.y, half.z * n.z};
  const V3 on_ball = unit(scaled_normal);
  return {half.x * on_ball.x, half.y * on_ball.y, half.z * on_ball.z};
}

// s = (p^e + q^e)^(1/e), from the logarithms of p and q, which become (p/s)^(e-1) and (q/s)^(e-1): its slopes. Returns log s.
double dual_norm(double& p, double& q, double e) {
  const double most = std::max(p, q), less = std::min(p, q);
  const double log_s = most + portable::log(1 + portable::exp(e * (less - most))) / e;
  p = portable::exp((e - 1) * (p - log_s));
  q = portable::exp((e - 1) * (q - log_s));
  return log_s;
}

// The norm whose unit ball is the superquadric has the support function as its dual norm, with exponents e/(e-1):
// h = || || (a n_x, b n_y) ||_e', c n_z ||_f'. The point is its gradient.
V3 superquadric_support(const RigidShape& shape, const V3& n) {
  constexpr double smallest = 1e-200;  // has a logarithm
  const V3& half = shape.half;
  double x = portable::log(half.x * std::abs(n.x) + smallest);
  double y = portable::log(half.y * std::abs(n.y) + smallest);
  double z = portable::log(half.z * std::abs(n.z) + smallest);
  double round = dual_norm(x, y, shape.exponent_xy);
  dual_norm(round, z, shape.exponent_z);
  const auto signed_as = [](double size, double sign) { return sign < 0 ? -size : size; };
  return {signed_as(half.x * round * x, n.x), signed_as(half.y * round * y, n.y),
          signed_as(half.z * z, n.z)};
}

V3 cylinder_support(const V3& half, const V3& n) {
  const double across = std::sqrt(n.x * n.x + n.y * n.y);
  const double share = across > 0 ? half.x / across : 0;
  return {share * n.x, share * n.y, n.z < 0 ? -half.z : half.z};
}

// Maximum of sqrt(x^2 + y^2) where (x/a)^e + (y/b)^e = 1 (Hoelder).
double farthest(double a, double b, double e) {
  if (e <= 2) return std::max(a, b);
  const double q = 2 * e / (e - 2), most = std::max(a, b);
  return most * portable::pow(portable::pow(a / most, q) + portable::pow(b / most, q), 1 / q);
}

void set_core(const SphereShape& s, double unit, RigidShape& rigid) {
  rigid.radius = s.diameter / 2 / unit;
  rigid.reach = rigid.radius;
}
void set_core(const EllipsoidShape& s, double unit, RigidShape& rigid) {
  rigid.core = RigidShape::Core::ellipsoid;
  rigid.half = vector_of(s.size / (2 * unit));
  rigid.reach = std::max({rigid.half.x, rigid.half.y, rigid.half.z});
}
void set_core(const SuperquadricShape& s, double unit, RigidShape& rigid) {
  set_core(EllipsoidShape{s.size}, unit, rigid);
  rigid.core = RigidShape::Core::superquadric;
  rigid.exponent_xy = s.exponent_xy / (s.exponent_xy - 1);
  rigid.exponent_z = s.exponent_z / (s.exponent_z - 1);
  const double across = farthest(rigid.half.x, rigid.half.y, s.exponent_xy);
  rigid.reach = farthest(across, rigid.half.z, s.exponent_z);
}
void set_core(const CylinderShape& s, double unit, RigidShape& rigid) {
  rigid.core = RigidShape::Core::cylinder;
  rigid.radius = s.rounding / unit;
  const double half = s.diameter / 2 / unit - rigid.radius;
  rigid.half = {half, half, s.height / 2 / unit - rigid.radius};
  rigid.reach = std::sqrt(half * half + rigid.half.z * rigid.half.z) + rigid.radius;
}

void set_points(std::vector<V3> points, double radius, RigidShape& rigid) {
  rigid.core = RigidShape::Core::points;
  rigid.radius = radius;
  for (const V3& p : points) rigid.reach = std::max(rigid.reach, length(p) + radius);
  rigid.table = SupportTable(std::move(points));
}

void set_core(const PolyhedronShape& s, double unit, RigidShape& rigid) {
  const Vec3 centre = centre_of(s);
  std::vector<HalfSpace> faces = faces_of_hull(s.corners);
  for (HalfSpace& face : faces) face.offset -= s.rounding;
  std::vector<V3> points;
  for (const Vec3& p : corners_between(faces)) points.push_back(vector_of((p - centre) / unit));
  set_points(std::move(points), s.rounding / unit, rigid);
}

std::vector<Vec3> directions_of_corners(const StlShape& s) {
  const Vec3 centre = centre_of_volume(s.triangles);
  std::vector<Vec3> corners;
  for (const Triangle& triangle : s.triangles)
    for (const Vec3& p : triangle) corners.push_back((p - centre) / (p - centre).norm());
  std::ranges::sort(corners, {}, [](const Vec3& p) { return std::tuple(p.x(), p.y(), p.z()); });
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

// On a side of a cube of directions, i and k from 0 to `samples`.
Vec3 direction_of_cell(int side, double i, double k) {
  const double u = 2 * i / samples - 1, v = 2 * k / samples - 1, w = side % 2 == 0 ? 1 : -1;
  const Vec3 d = side < 2 ? Vec3(w, u, v) : side < 4 ? Vec3(v, w, u) : Vec3(u, v, w);
  return d / d.norm();
}

std::vector<Vec3> even_directions() {
  std::vector<Vec3> all;
  for (int side = 0; side < 6; ++side)
    for (int i = 0; i <= samples; ++i)
      for (int k = 0; k <= samples; ++k) all.push_back(direction_of_cell(side, i, k));
  return all;
}

std::vector<V3> points_along(const StarSurface& surface, const std::vector<Vec3>& directions,
                             double unit) {
  std::vector<V3> points;
  for (const Vec3& d : directions) points.push_back(vector_of(surface.point(d) / unit));
  return points;
}

struct OutsidePoint {
  Vec3 point, direction;
  double at_most;  // upper bound of the distance from the hull
};

// A surface point over a cell, unless it is inside the hull, which contains the triangle seen behind it.
std::optional<OutsidePoint> outside(const Vec3& point, const Vec3& direction,
                                    const Triangle& triangle) {
  const Vec3 normal = area_vector(triangle);
  if (point.norm() * normal.dot(direction) <= normal.dot(triangle[0])) return {};
  return OutsidePoint{point, direction, (point - closest_point(triangle, point)).norm()};
}

// The points outside among nine in each cell of the cube.
std::vector<OutsidePoint> points_outside(const StarSurface& surface) {
  std::vector<OutsidePoint> found;
  const auto grid = even_directions();
  std::vector<Vec3> corners;
  for (const Vec3& d : grid) corners.push_back(surface.point(d));
  const auto corner = [&](int side, int i, int k) {
    return corners[static_cast<std::size_t>((side * (samples + 1) + i) * (samples + 1) + k)];
  };
  for (int side = 0; side < 6; ++side)
    for (int i = 0; i < samples; ++i)
      for (int k = 0; k < samples; ++k) {
        const Vec3 low = corner(side, i + 1, k), high = corner(side, i, k + 1);
        for (int place = 0; place < 9; ++place) {
          const double right = place % 3 / 3.0, up = place / 3 / 3.0;
          const Vec3 d = direction_of_cell(side, i + right, k + up);
          Triangle triangle = right + up <= 1 ? Triangle{corner(side, i, k), low, high}
                                              : Triangle{corner(side, i + 1, k + 1), high, low};
          if (side % 2 != 0) std::swap(triangle[1], triangle[2]);  // seen from outside
          if (auto point = outside(surface.point(d), d, triangle)) found.push_back(*point);
        }
      }
  return found;
}

// The maximum distance of the surface outside the hull; a quarter more, since it is sampled. A sphere of this
// radius around each of the hull's points covers it. The distance from a hull of many points is expensive, so it is only
// computed where it may be the maximum.
double bulge_of(const StarSurface& surface, const RigidShape& hull, double unit) {
  std::vector<OutsidePoint> points = points_outside(surface);
  std::ranges::sort(points, std::greater(), &OutsidePoint::at_most);
  const RigidShape ball;
  double most = 0;
  for (const OutsidePoint& p : points) {
    if (p.at_most / unit <= most) break;
    const RigidPose here, there{vector_of(p.point / unit), {}};
    const RigidPair pair(hull, here, ball, there);
    V3 normal = vector_of(p.direction);
    const auto touch = pair.touch(std::numeric_limits<double>::max(), normal, 1e-9);
    if (touch) most = std::max(most, pair.distance(touch->normal));
  }
  return 1.25 * most;
}

// The convex hull: hollows are filled. Of its corners or, if there are many or the surface is smoothed, of points on it,
// plus the bulge between them.
void set_core(const StlShape& s, double unit, RigidShape& rigid) {
  const auto surface = star_surface(s);
  std::vector<Vec3> directions = directions_of_corners(s);
  const bool few = directions.size() <= most_corners;
  if (s.smoothing == 0 && few)
    return set_points(points_along(*surface, directions, unit), 0, rigid);
  const std::vector<Vec3> even = even_directions();
  if (!few) directions.clear();
  directions.insert(directions.end(), even.begin(), even.end());
  std::vector<V3> points = points_along(*surface, directions, unit);
  set_points(std::move(points), 0, rigid);
  rigid.radius = bulge_of(*surface, rigid, unit);
  rigid.reach += rigid.radius;
}

double extent_along(const RigidShape& rigid, const V3& n) {
  return dot(rigid.support(n) - rigid.support(-n), n);
}
V3 extent_of(const RigidShape& rigid) {
  return {extent_along(rigid, {1, 0, 0}), extent_along(rigid, {0, 1, 0}),
          extent_along(rigid, {0, 0, 1})};
}

void scale_shape(SphereShape& s, double k) { s.diameter *= k; }
void scale_shape(EllipsoidShape& s, double k) { s.size *= k; }
void scale_shape(SuperquadricShape& s, double k) { s.size *= k; }
void scale_shape(CylinderShape& s, double k) {
  s.diameter *= k;
  s.height *= k;
  s.rounding *= k;
}
void scale_shape(PolyhedronShape& s, double k) {
  for (Vec3& corner : s.corners) corner *= k;
  s.rounding *= k;
}
void scale_shape(StlShape& s, double k) {
  if (s.diameter) *s.diameter *= k;
  for (auto& triangle : s.triangles)
    for (Vec3& corner : triangle) corner *= k;
}

// Its diameter.
double ball_of(double volume) { return portable::cbrt(6 / std::numbers::pi * volume); }

struct RigidKey {
  ParticleShape shape;
  double unit;
  bool operator==(const RigidKey&) const = default;
};

RigidShape make_rigid(const RigidKey& key) {
  const auto& [shape, unit] = key;
  RigidShape rigid;
  std::visit([&rigid, length = unit](const auto& s) { set_core(s, length, rigid); }, shape);
  const V3 half = 0.5 * extent_of(rigid);
  rigid.content = volume_of(shape) / (unit * unit * unit);
  rigid.gyration = 2.0 / 15 * dot(half, half);  // for an ellipsoid, the mean over its axes
  rigid.diameter = ball_of(rigid.content);
  return rigid;
}

}  // namespace

RigidShape rigid_shape(const ParticleShape& shape, double unit) {
  // Those of STL shapes are expensive, and a check and the run request the same ones.
  static ResultCache<RigidKey, RigidShape> cache(16 << 20);  // bytes, approximately
  const auto size = [&](const RigidShape& made) {
    return sizeof(RigidKey) + stl_bytes(shape) + made.table.bytes();
  };
  return cache.get({shape, unit}, make_rigid, size);
}

RigidShape contact_shape(const ParticleSpec& particle, double unit) {
  constexpr double little = 0.002;  // of the mean radius: spheres are taken as they are
  RigidShape shape = rigid_shape(particle.shape, unit);
  try {
    const double bulge = space::make_shape(particle).surface_bulge / unit;
    if (bulge < little * shape.diameter / 2) return shape;
    shape.radius += bulge;
    shape.reach += bulge;
  } catch (const std::invalid_argument&) {  // it has no mesh: the particle layout reports that
  }
  return shape;
}

double volume_of(const ParticleShape& shape) { return star_surface(shape)->volume(); }
double diameter_of(const ParticleShape& shape) { return ball_of(volume_of(shape)); }

ParticleShape scaled(const ParticleShape& shape, double factor) {
  ParticleShape larger = shape;
  std::visit([&](auto& s) { scale_shape(s, factor); }, larger);
  return larger;
}

V3 RigidShape::core_support(const V3& n) const {
  switch (core) {
    case Core::ellipsoid:
      return ellipsoid_support(half, n);
    case Core::superquadric:
      return superquadric_support(*this, n);
    case Core::cylinder:
      return cylinder_support(half, n);
    case Core::points:
      return table.extreme(n);
    default:
      return {};
  }
}

V3 RigidShape::support(const V3& n) const { return core_support(n) + radius * n; }

}  // namespace pulvis::space
