// check_overlaps: FCL's broad phase finds the pairs whose boxes meet. Where a disc is involved the
// depth has a formula, which is exact where FCL's iterations (GJK, about 1e-6) would not tell
// touching from overlapping; two rectangles are left to FCL's separating axes.
#include "scenes/place.hpp"
#include "scenes/problem.hpp"
#include "scenes/surface.hpp"
#include "scenes/surface_overlap.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/narrowphase/collision.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace pulvis {
namespace {

using Object = fcl::CollisionObject<double>;
using Geometry = std::shared_ptr<fcl::CollisionGeometry<double>>;
using Pose = fcl::Transform3<double>;

constexpr std::size_t most_reports = 20;  // a packing that is too dense overlaps everywhere

struct Overlap {
  std::size_t particle;
  std::size_t other;  // particle or tool
  double depth;       // m
};

bool is_disc(const Outline& outline) { return std::holds_alternative<DiscOutline>(outline); }

double radius_of(const Outline& disc) { return std::get<DiscOutline>(disc).diameter / 2; }

Vec2 half_size(const Outline& outline) {
  if (is_disc(outline)) return Vec2::Constant(radius_of(outline));
  const auto& rectangle = std::get<RectangleOutline>(outline);
  return Vec2(rectangle.width, rectangle.height) / 2;
}

double size_of(const Outline& outline) { return 2 * half_size(outline).minCoeff(); }

// Far deeper than wide, so that FCL never finds the way out along z to be the shortest.
Geometry geometry(const Outline& outline, double depth) {
  if (is_disc(outline)) return std::make_shared<fcl::Cylinder<double>>(radius_of(outline), depth);
  const Vec2 size = 2 * half_size(outline);
  return std::make_shared<fcl::Box<double>>(size.x(), size.y(), depth);
}

Pose pose(const BodySpec& body) {
  Pose result = Pose::Identity();
  result.translation() << body.position.x(), body.position.y(), 0;
  result.linear() = Eigen::AngleAxisd(body.angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return result;
}

double disc_rectangle(const BodySpec& disc, const Outline& disc_outline, const BodySpec& body,
                      const Outline& outline) {
  const double radius = radius_of(disc_outline);
  const Vec2 centre = Eigen::Rotation2Dd(-body.angle) * (disc.position - body.position);
  const Vec2 half = half_size(outline);
  const Vec2 beyond = centre.cwiseAbs() - half;
  if (beyond.maxCoeff() <= 0) return radius - beyond.maxCoeff();  // centre inside the rectangle
  return radius - beyond.cwiseMax(0).norm();
}

double rectangle_rectangle(const Object& a, const Object& b) {
  const fcl::CollisionRequest<double> request(16, true);
  fcl::CollisionResult<double> result;
  fcl::collide(&a, &b, request, result);
  double deepest = 0;
  for (std::size_t i = 0; i < result.numContacts(); ++i)
    deepest = std::max(deepest, result.getContact(i).penetration_depth);
  return deepest;
}

// How far the outline reaches behind the tool's surface.
double depth_behind(const ToolSpec& tool, const BodySpec& body, const Outline& outline) {
  const double centre = (body.position - tool.point).dot(tool.normal);
  if (is_disc(outline)) return radius_of(outline) - centre;
  const Vec2 normal = Eigen::Rotation2Dd(-body.angle) * tool.normal;
  return normal.cwiseAbs().dot(half_size(outline)) - centre;
}

class OverlapSearch {
 public:
  OverlapSearch(const Scene& scene, const std::vector<BodySpec>& bodies)
      : scene_(scene), bodies_(bodies) {
    double reach = 0;
    for (const ParticleSpec& particle : scene.particles)
      reach = std::max(reach, half_size(particle.outline).norm());
    std::vector<Geometry> shapes;
    for (const ParticleSpec& particle : scene.particles)
      shapes.push_back(geometry(particle.outline, 16 * reach));
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
      return false;  // go on
    });
    return sorted();
  }

  // The tools are asked one by one: the boxes of oblique planes are infinite, which a tree cannot
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
    const fcl::Vector3d normal(tool.normal.x(), tool.normal.y(), 0);
    return Object(std::make_shared<fcl::Halfspace<double>>(normal, tool.normal.dot(tool.point)));
  }

  // std::less orders any two pointers, also such that do not point into one array.
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

  double depth(const Object& first, const Object& second) const {
    const BodySpec& a = bodies_[number(first)];
    const BodySpec& b = bodies_[number(second)];
    const Outline& outline_a = outline(a);
    const Outline& outline_b = outline(b);
    if (!is_disc(outline_a) && !is_disc(outline_b)) return rectangle_rectangle(first, second);
    if (!is_disc(outline_a)) return disc_rectangle(b, outline_b, a, outline_a);
    if (!is_disc(outline_b)) return disc_rectangle(a, outline_a, b, outline_b);
    return radius_of(outline_a) + radius_of(outline_b) - (a.position - b.position).norm();
  }

  void pair(const Object& first, const Object& second) {
    const std::size_t i = number(first), j = number(second);
    const double size = std::min(size_of(outline(bodies_[i])), size_of(outline(bodies_[j])));
    const double overlap = depth(first, second);
    if (overlap > touching_tolerance * size)
      found_.push_back({std::max(i, j), std::min(i, j), overlap});
  }

  void behind_tool(const Object& object) {
    const std::size_t i = number(object);
    const double overlap = depth_behind(scene_.tools[tool_], bodies_[i], outline(bodies_[i]));
    if (overlap > touching_tolerance * size_of(outline(bodies_[i])))
      found_.push_back({i, tool_, overlap});
  }

  // Every particle is asked: one that lies deep in the tool is near none of its pieces.
  void behind_polyline(const ToolSpec& tool) {
    const ToolSurface surface = make_surface(tool.points, tool.rounding);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Outline& shape = outline(bodies_[i]);
      const Vec2 centre = bodies_[i].position - tool.points.front();
      const double overlap =
          is_disc(shape) ? disc_depth(surface, centre, radius_of(shape))
                         : rectangle_depth(surface, centre, bodies_[i].angle, half_size(shape));
      if (overlap > touching_tolerance * size_of(shape)) found_.push_back({i, tool_, overlap});
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
  fcl::DynamicAABBTreeCollisionManager<double> tree_;
  std::vector<Overlap> found_;
  std::size_t tool_ = 0;
};

class Report {
 public:
  Report(const Scene& scene, const std::vector<BodySpec>& bodies)
      : scene_(scene), bodies_(bodies) {}

  void particles(const std::vector<Overlap>& overlaps) {
    for (const Overlap& overlap : overlaps)
      add(overlap,
          fmt::format("{} overlaps {} by {:.6g} m, allowed: particles that touch or are apart",
                      described(overlap.particle), described(overlap.other), overlap.depth));
  }

  void tools(const std::vector<Overlap>& overlaps) {
    for (const Overlap& overlap : overlaps)
      add(overlap,
          fmt::format("{} is outside the die: it reaches {:.6g} m behind tool '{}', allowed: "
                      "particles in front of every tool",
                      described(overlap.particle), overlap.depth,
                      scene_.tools[overlap.other].name));
  }

  void throw_if_any() const {
    if (!problems_.empty()) throw SceneError(problems_);
  }

 private:
  void add(const Overlap& overlap, const std::string& message) {
    if (problems_.size() > most_reports) return;
    const BodySpec& body = bodies_[overlap.particle];
    const bool last = problems_.size() == most_reports;
    problems_.push_back({scene_.file.string(), body.mark.line, body.mark.column, "",
                         last ? "scene" : key_of(body),
                         last ? "there are more overlaps, not listed" : message});
  }

  // A packing's particles share its mark, so the mark tells where a particle comes from.
  std::string key_of(const BodySpec& body) const {
    const auto same = [&](SourceMark mark) {
      return mark.line == body.mark.line && mark.column == body.mark.column;
    };
    for (std::size_t i = 0; i < scene_.packings.size(); ++i)
      if (same(scene_.packings[i].mark)) return fmt::format("packing[{}]", i);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i)
      if (same(scene_.bodies[i].mark)) return fmt::format("body[{}].position", i);
    return "particle";
  }

  std::string described(std::size_t i) const {
    const BodySpec& body = bodies_[i];
    return fmt::format("particle {} ('{}' at ({:.6g}, {:.6g}) m)", i,
                       scene_.particles[static_cast<std::size_t>(body.particle)].name,
                       body.position.x(), body.position.y());
  }

  const Scene& scene_;
  const std::vector<BodySpec>& bodies_;
  std::vector<SceneProblem> problems_;
};

}  // namespace

void check_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (bodies.empty()) return;
  OverlapSearch search(scene, bodies);
  Report report(scene, bodies);
  report.tools(search.with_tools());
  report.particles(search.between_particles());
  report.throw_if_any();
}

}  // namespace pulvis
