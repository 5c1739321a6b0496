// FCL's broad phase finds the pairs whose boxes intersect. Between rounded boxes the depth has a
// closed form, which is exact where iterations (GJK, about 1e-6) could not distinguish contact from overlap.
// Other outlines are treated as inscribed polygons in convex pieces (scenes/packing/outlines/rigid_contact): touching ones
// are not refused, and an overlap below twice the polygons' deviation is not detected.
#include "scenes/checks/outline_overlaps.hpp"

#include "scenes/checks/surface_overlap.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/outlines/outline_reach.hpp"
#include "scenes/packing/outlines/outline_depth.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/spec/rotation.hpp"
#include "scenes/tools/surface.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/halfspace.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace pulvis {
namespace {

using Object = fcl::CollisionObject<double>;
using Geometry = std::shared_ptr<fcl::CollisionGeometry<double>>;
using Pose = fcl::Transform3<double>;

// The box itself, or the box around any other outline, for the broad phase.
RoundedBox box_around(const Outline& outline) {
  if (const auto box = rounded_box(outline)) return *box;
  Vec2 half = Vec2::Zero();
  for (const Vec2& p : check_polygon(outline)) half = half.cwiseMax(p.cwiseAbs());
  return {half * (1 + 10 * check_deviation), 0};
}

Vec2 half_size(const Outline& outline) {
  const RoundedBox box = box_around(outline);
  return box.half + Vec2::Constant(box.radius);
}

double size_of(const Outline& outline) { return 2 * half_size(outline).minCoeff(); }

// For the broad phase, which only requests its box.
Geometry geometry(const Outline& outline, double depth) {
  const RoundedBox box = box_around(outline);
  if (box.half.isZero(0)) return std::make_shared<fcl::Cylinder<double>>(box.radius, depth);
  const Vec2 size = 2 * half_size(outline);
  return std::make_shared<fcl::Box<double>>(size.x(), size.y(), depth);
}

Pose pose(const BodySpec& body) {
  Pose result = Pose::Identity();
  result.translation() << body.position.x(), body.position.y(), 0;
  result.linear() = rotation_about_z(body.angle);
  return result;
}

// How far a body extends behind the tool's surface.
double depth_behind(const ToolSpec& tool, const BodySpec& body, const OutlineReach& reach) {
  return reach.along(body.angle, -in_plane(tool.normal)) -
         (body.position - tool.point).dot(tool.normal);
}

class OverlapSearch {
 public:
  OverlapSearch(const Scene& scene, const std::vector<BodySpec>& bodies)
      : scene_(scene), bodies_(bodies), depths_(scene) {
    double reach = 0;
    for (const ParticleSpec& particle : scene.particles)
      reach = std::max(reach, half_size(particle.outline).norm());
    std::vector<Geometry> shapes;
    for (const ParticleSpec& particle : scene.particles)
      shapes.push_back(geometry(particle.outline, 16 * reach));
    for (const ParticleSpec& particle : scene.particles) {
      sizes_.push_back(size_of(particle.outline));
      reaches_.emplace_back(particle.outline);
      polygons_.push_back(rounded_box(particle.outline) ? std::vector<Vec2>{}
                                                        : check_polygon(particle.outline));
    }
    objects_.reserve(bodies.size());
    for (const BodySpec& body : bodies)
      objects_.emplace_back(shapes[static_cast<std::size_t>(body.particle)], pose(body));
    std::vector<Object*> all;
    for (Object& object : objects_) all.push_back(&object);
    tree_.registerObjects(all);
    tree_.setup();
  }

  std::vector<Overlap> between_particles() {
    found_.clear();
    tree_.collide(this, [](Object* a, Object* b, void* self) {
      static_cast<OverlapSearch*>(self)->pair(*a, *b);
      return false;  // continue the query
    });
    return sorted();
  }

  std::size_t pairs() const { return pairs_; }

  // If flipped, the tool would have every particle in front of it.
  bool is_reversed(const ToolSpec& tool) const {
    if (tool.shape == ToolSpec::Shape::polyline) {
      const std::vector<Vec2> points(tool.points.rbegin(), tool.points.rend());
      const ToolSurface surface = make_surface(points, 0);
      return all_of_bodies([&](std::size_t i) {
        return depth_in_tool(surface, in_plane(bodies_[i].position) - points.front(),
                             bodies_[i].angle, check_polygon(outline(bodies_[i])));
      });
    }
    ToolSpec turned = tool;
    turned.normal = -tool.normal;
    return all_of_bodies([&](std::size_t i) {
      return depth_behind(turned, bodies_[i], reaches_[kind(bodies_[i])]);
    });
  }

  // Tools are checked one by one: the boxes of oblique planes are infinite, which a tree cannot
  // balance.
  std::vector<Overlap> with_tools() {
    found_.clear();
    for (tool_ = 0; tool_ < scene_.tools.size(); ++tool_) {
      const ToolSpec::Shape shape = scene_.tools[tool_].shape;
      if (shape == ToolSpec::Shape::polyline) behind_polyline(scene_.tools[tool_]);
      if (shape != ToolSpec::Shape::plane) continue;
      Object plane = half_space(scene_.tools[tool_]);
      tree_.collide(&plane, this, [](Object* a, Object* b, void* self) {
        auto& search = *static_cast<OverlapSearch*>(self);
        search.behind_tool(search.is_particle(*a) ? *a : *b);
        return false;
      });
    }
    return sorted();
  }

 private:
  static Object half_space(const ToolSpec& tool) {
    return Object(
        std::make_shared<fcl::Halfspace<double>>(tool.normal, tool.normal.dot(tool.point)));
  }

  // std::less orders any two pointers, even those into different arrays.
  bool is_particle(const Object& object) const {
    const std::less<const Object*> before;
    return !before(&object, objects_.data()) && before(&object, objects_.data() + objects_.size());
  }

  std::size_t number(const Object& object) const {
    return static_cast<std::size_t>(&object - objects_.data());
  }

  const Outline& outline(const BodySpec& body) const {
    return scene_.particles[static_cast<std::size_t>(body.particle)].outline;
  }

  static std::size_t kind(const BodySpec& body) { return static_cast<std::size_t>(body.particle); }

  template <class Depth>
  bool all_of_bodies(const Depth& depth) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (depth(i) > allowed(i)) return false;
    return true;
  }

  double allowed(std::size_t i) const { return touching_tolerance * sizes_[kind(bodies_[i])]; }

  void pair(const Object& first, const Object& second) {
    const std::size_t i = number(first), j = number(second);
    ++pairs_;
    const double overlap = depths_.between(bodies_[i], bodies_[j]);
    if (overlap > std::min(allowed(i), allowed(j)))
      found_.push_back({std::max(i, j), std::min(i, j), overlap});
  }

  void behind_tool(const Object& object) {
    const std::size_t i = number(object);
    const double overlap =
        depth_behind(scene_.tools[tool_], bodies_[i], reaches_[kind(bodies_[i])]);
    if (overlap > allowed(i)) found_.push_back({i, tool_, overlap});
  }

  // All particles are checked: one that lies deep inside the tool is near none of its pieces.
  void behind_polyline(const ToolSpec& tool) {
    const ToolSurface surface = make_surface(tool.points, tool.rounding);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Vec2 centre = in_plane(bodies_[i].position) - tool.points.front();
      const auto box = rounded_box(outline(bodies_[i]));
      const double overlap =
          box ? depth_in_tool(surface, centre, bodies_[i].angle, *box)
              : depth_in_tool(surface, centre, bodies_[i].angle, polygons_[kind(bodies_[i])]);
      if (overlap > allowed(i)) found_.push_back({i, tool_, overlap});
    }
  }

  std::vector<Overlap> sorted() const {
    std::vector<Overlap> result = found_;
    std::sort(result.begin(), result.end(), [](const Overlap& a, const Overlap& b) {
      return std::pair(a.particle, a.other) < std::pair(b.particle, b.other);
    });
    return result;
  }

  const Scene& scene_;
  const std::vector<BodySpec>& bodies_;
  std::vector<Object> objects_;  // by particle number
  std::vector<double> sizes_;    // by class, as are the following
  std::vector<OutlineReach> reaches_;
  std::vector<std::vector<Vec2>> polygons_;  // empty for a rounded box
  OutlineDepths depths_;
  fcl::DynamicAABBTreeCollisionManager<double> tree_;
  std::vector<Overlap> found_;
  std::size_t tool_ = 0;
  std::size_t pairs_ = 0;  // with intersecting boxes
};

}  // namespace

Overlaps outline_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies) {
  OverlapSearch search(scene, bodies);
  Overlaps found{search.between_particles(), search.with_tools(), {}, search.pairs()};
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    found.reversed.push_back(std::ranges::find(found.with_tools, t, &Overlap::other) !=
                                 found.with_tools.end() &&
                             search.is_reversed(scene.tools[t]));
  return found;
}

}  // namespace pulvis
