// check_overlaps: FCL's broad phase finds the pairs whose boxes intersect. Between rounded boxes the depth has a
// closed form, which is exact where iterations (GJK, about 1e-6) could not distinguish contact from overlap.
// Other outlines are treated as inscribed polygons in convex pieces (scenes/packing/rigid_contact): touching ones
// are not refused, and an overlap below twice the polygons' deviation is not detected.
#include "scenes/checks/overlaps.hpp"

#include "scenes/checks/far_away.hpp"
#include "scenes/checks/surface_overlap.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/outlines/outline_reach.hpp"
#include "scenes/packing/outline_depth.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/spec/rotation.hpp"
#include "scenes/tools/cell.hpp"
#include "scenes/tools/surface.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

namespace pulvis {
namespace {

using Object = fcl::CollisionObject<double>;
using Geometry = std::shared_ptr<fcl::CollisionGeometry<double>>;
using Pose = fcl::Transform3<double>;

constexpr std::size_t max_reports = 20;  // a packing that is too dense overlaps everywhere

struct Overlap {
  std::size_t particle;
  std::size_t other;  // particle or tool
  double depth;       // m
};

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

class Report {
 public:
  // `count` particles, followed by all their images.
  Report(const Scene& scene, const std::vector<BodySpec>& bodies, std::size_t count)
      : scene_(scene), bodies_(bodies), count_(count) {}

  void particles(const std::vector<Overlap>& overlaps) {
    for (const Overlap& overlap : overlaps) {
      if (overlap.other >= count_) continue;  // two images
      add(overlap,
          fmt::format("{} overlaps {} by {:.6g} m, allowed: particles that touch or are apart",
                      described(overlap.particle), described(overlap.other), overlap.depth));
    }
  }

  void tools(const std::vector<Overlap>& overlaps, const OverlapSearch& search) {
    std::map<std::size_t, bool> reversed;
    for (const Overlap& overlap : overlaps) {
      const auto [tool, fresh] = reversed.try_emplace(overlap.other, false);
      if (fresh) tool->second = search.is_reversed(scene_.tools[overlap.other]);
      if (fresh && tool->second) turned_away(overlap.other);
      if (!tool->second) outside(overlap);
    }
  }

  void throw_if_any() const {
    if (!problems_.empty()) throw SceneError(problems_);
  }

 private:
  void turned_away(std::size_t number) {
    const ToolSpec& tool = scene_.tools[number];
    const bool plane = tool.shape == ToolSpec::Shape::plane;
    problems_.push_back(
        {scene_.file_of(tool.mark).string(), tool.mark.line, tool.mark.column, "",
         fmt::format("tool[{}].{}", number, plane ? "normal" : "points"),
         plane
             ? fmt::format(
                   "tool '{}' faces away from the powder: every particle lies behind it, "
                   "allowed: a normal that points from the tool into the powder, [{:g}, {:g}]",
                   tool.name, 0 - tool.normal.x(), 0 - tool.normal.y())
             : fmt::format("tool '{}' faces away from the powder: every particle lies inside it, "
                           "allowed: the points in the opposite order, with the powder to the left",
                           tool.name)});
  }

  void outside(const Overlap& overlap) {
    add(overlap,
        fmt::format("{} is outside the die: it reaches {:.6g} m behind tool '{}', allowed: "
                    "particles in front of every tool",
                    described(overlap.particle), overlap.depth, scene_.tools[overlap.other].name));
  }

  void add(const Overlap& overlap, const std::string& message) {
    if (problems_.size() > max_reports) return;
    const BodySpec& body = bodies_[overlap.particle];
    const bool last = problems_.size() == max_reports;
    problems_.push_back({scene_.file_of(body.mark).string(), body.mark.line, body.mark.column, "",
                         last ? "scene" : key_of(body),
                         last ? "there are more overlaps that are not listed" : message});
  }

  // All particles of a packing share its mark, so the mark identifies the source of a particle.
  std::string key_of(const BodySpec& body) const {
    for (std::size_t i = 0; i < scene_.packings.size(); ++i)
      if (scene_.packings[i].mark == body.mark) return fmt::format("packing[{}]", i);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i)
      if (scene_.bodies[i].mark == body.mark) return fmt::format("body[{}].position", i);
    return "particle";
  }

  std::string described(std::size_t i) const {
    const BodySpec& body = bodies_[i];
    return fmt::format("{}particle {} ('{}' at ({:.6g}, {:.6g}) m)",
                       i < count_ ? "" : "the image of ", i % count_,
                       scene_.particles[static_cast<std::size_t>(body.particle)].name,
                       body.position.x(), body.position.y());
  }

  const Scene& scene_;
  const std::vector<BodySpec>& bodies_;
  std::size_t count_;
  std::vector<SceneProblem> problems_;
};

}  // namespace

namespace {

// The bodies, followed by their images across the cell boundaries.
std::vector<BodySpec> with_images(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::vector<BodySpec> all = bodies;
  if (!scene.cell) return all;
  const auto [first, second] = cell_vectors(*scene.cell);
  for (int i = -1; i <= 1; ++i)
    for (int k = -1; k <= 1; ++k)
      for (const BodySpec& body : bodies) {
        if (i == 0 && k == 0) break;
        all.push_back(body);
        all.back().position.head<2>() += i * first + k * second;
      }
  return all;
}

}  // namespace

std::size_t check_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (bodies.empty()) return 0;
  check_distance(scene, scene, bodies, [&](const BodySpec& body) {
    return std::sqrt(outline_area(scene.class_of(body).outline));
  });
  const std::vector<BodySpec> all = with_images(scene, bodies);
  OverlapSearch search(scene, all);
  Report report(scene, all, bodies.size());
  report.tools(search.with_tools(), search);
  report.particles(search.between_particles());
  report.throw_if_any();
  return search.pairs();
}

}  // namespace pulvis
