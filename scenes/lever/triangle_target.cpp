#include "scenes/lever/triangle_target.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

constexpr double blend = 1e-3;        // of the unit
constexpr double blend_reach = 20;    // in blends: exp(-20) is a negligible weight
constexpr double valley_reach = 0.2;  // of the unit, past a valley
constexpr double same_plane = 1e-12;  // of lengths; of directions

fcl::CollisionObjectd sphere(const Vec3& centre, double radius) {
  fcl::Transform3d at = fcl::Transform3d::Identity();
  at.translation() = centre;
  return {std::make_shared<fcl::Sphered>(radius), at};
}

Vec3 on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return a + s * (b - a);
}

}  // namespace

TriangleTarget::TriangleTarget(std::vector<Vec3> points, std::vector<fcl::Triangle> triangles,
                               double unit)
    : points_(std::move(points)),
      triangles_(std::move(triangles)),
      unit_(unit),
      delta_(blend * unit) {
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<Vec3> scaled;
  for (const Vec3& p : points_) scaled.push_back(p / unit_);
  model->beginModel();
  model->addSubModel(scaled, triangles_);
  model->endModel();
  surface_ = std::make_unique<fcl::CollisionObjectd>(model);
  for (const fcl::Triangle& t : triangles_)
    normals_.push_back(
        (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]).normalized());
  find_valleys();
}

// An edge is a valley where the neighbour's third corner lies above the triangle.
void TriangleTarget::find_valleys() {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t>
      opposite;  // by edge, counter-clockwise
  for (const fcl::Triangle& t : triangles_)
    for (int k = 0; k < 3; ++k) opposite[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const fcl::Triangle& t = triangles_[i];
    std::array<bool, 3> valley{};
    for (int k = 0; k < 3; ++k) {
      const auto across = opposite.find({t[(k + 1) % 3], t[k]});
      if (across == opposite.end()) continue;
      const double above = normals_[i].dot(points_[across->second] - points_[t[k]]);
      valley[static_cast<std::size_t>(k)] = above > same_plane * unit_;
    }
    valley_edges_.push_back(valley);
  }
}

std::size_t TriangleTarget::nearest_triangle(const Vec3& p) const {
  const fcl::CollisionObjectd point = sphere(p / unit_, 1e-9);
  fcl::DistanceRequestd request(true);
  fcl::DistanceResultd result;
  fcl::distance(surface_.get(), &point, request, result);
  return static_cast<std::size_t>(result.b1);
}

std::vector<std::size_t> TriangleTarget::triangles_within(const Vec3& p, double distance) const {
  const fcl::CollisionObjectd ball = sphere(p / unit_, distance / unit_);
  fcl::CollisionRequestd request(triangles_.size(), true);
  fcl::CollisionResultd result;
  fcl::collide(surface_.get(), &ball, request, result);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < result.numContacts(); ++i)
    found.push_back(static_cast<std::size_t>(result.getContact(i).b1));
  std::ranges::sort(found);
  return found;
}

TriangleTarget::Side TriangleTarget::towards(const Vec3& p, std::size_t triangle) const {
  const fcl::Triangle& t = triangles_[triangle];
  const Vec3& n = normals_[triangle];
  const double height = n.dot(p - points_[t[0]]);
  const Vec3 foot = p - height * n;
  Vec3 best = foot;
  bool inside = true;
  double minimum = std::numeric_limits<double>::infinity();
  Vec3 along = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = points_[t[k]], &b = points_[t[(k + 1) % 3]];
    inside = inside && n.dot((b - a).cross(foot - a)) >= 0;
    const Vec3 q = on_segment(p, a, b);
    if ((q - p).squaredNorm() >= minimum) continue;
    minimum = (q - p).squaredNorm();
    best = q;
    const bool corner = q == a || q == b;
    along = corner ? Vec3(Vec3::Zero()) : Vec3((b - a).normalized());
  }
  const double distance = std::sqrt(minimum);
  if (inside || distance == 0) return {height, n, Eigen::Matrix3d::Zero()};
  const double side = height < 0 ? -1 : 1;
  const Vec3 out = side * (p - best) / distance;
  const Eigen::Matrix3d turn =
      (Eigen::Matrix3d::Identity() - out * out.transpose() - along * along.transpose()) /
      (side * distance);
  return {side * distance, out, turn};
}

bool TriangleTarget::faces(const Vec3& p, std::size_t triangle) const {
  const fcl::Triangle& t = triangles_[triangle];
  const Vec3& n = normals_[triangle];
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = points_[t[k]], &b = points_[t[(k + 1) % 3]];
    const double within = n.dot((b - a).normalized().cross(p - a));
    if (within >= 0) continue;
    if (!valley_edges_[triangle][static_cast<std::size_t>(k)] || within < -valley_reach * unit_)
      return false;
  }
  return true;
}

TargetShape::Nearest TriangleTarget::blended(const std::vector<Side>& sides) const {
  double minimum = sides.front().distance;
  for (const Side& side : sides) minimum = std::min(minimum, side.distance);
  double sum = 0;
  Vec3 mean = Vec3::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Side& side : sides) {
    const double weight = portable::exp((minimum - side.distance) / delta_);
    sum += weight;
    mean += weight * side.normal;
    spread += weight * (side.turn - side.normal * side.normal.transpose() / delta_);
  }
  mean /= sum;
  spread = spread / sum + mean * mean.transpose() / delta_;
  const double length = mean.norm();
  const Vec3 n = mean / length;
  const Eigen::Matrix3d turn = (Eigen::Matrix3d::Identity() - n * n.transpose()) * spread / length;
  Nearest result{minimum - delta_ * portable::log(sum), {n.x(), n.y(), n.z()}, {}};
  for (int i = 0; i < 9; ++i) result.turn[static_cast<std::size_t>(i)] = turn(i / 3, i % 3);
  return result;
}

TargetShape::Nearest TriangleTarget::nearest(const Place& place) const {
  const Vec3 p(place[0], place[1], place[2]);
  const std::size_t first = nearest_triangle(p);
  std::vector<Side> sides{towards(p, first)};
  const double nearest = sides.front().distance, reach = blend_reach * delta_;
  for (const std::size_t t : triangles_within(p, std::abs(nearest) + reach)) {
    if (t == first || !faces(p, t)) continue;
    const double height = normals_[t].dot(p - points_[triangles_[t][0]]);
    const bool known = std::ranges::any_of(
        sides, [&](const Side& side) { return side.normal.dot(normals_[t]) > 1 - same_plane; });
    if (!known && height < nearest + reach)
      sides.push_back({height, normals_[t], Eigen::Matrix3d::Zero()});
  }
  return blended(sides);
}

}  // namespace pulvis
