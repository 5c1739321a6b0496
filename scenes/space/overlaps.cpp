#include "scenes/space/overlaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/portable_math.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/space/packing/place.hpp"
#include "scenes/space/packing/rigid_contact.hpp"

namespace pulvis::space {
namespace {

constexpr std::size_t most_told = 20;  // a packing that is too dense overlaps everywhere

V3 plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vector_of(const V3& v) { return {v.x, v.y, v.z}; }

class SpaceOverlaps {
 public:
  SpaceOverlaps(const Scene& scene, const std::vector<BodySpec>& bodies)
      : scene_(scene), space_(*scene.space), bodies_(bodies) {
    for (const ParticleSpec& particle : space_.particles)
      shapes_.push_back(rigid_shape(particle.shape, 1));
    for (const BodySpec& body : bodies)
      poses_.push_back({plain(body.position), {body.rotation.w(), body.rotation.x(),
                                               body.rotation.y(), body.rotation.z()}});
  }

  void with_tools() {
    for (const ToolSpec& tool : space_.tools)
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const double depth = depth_in(tool, i);
        if (depth > allowed(i))
          add(i, fmt::format("{} is outside the die: it reaches {:.6g} m behind tool '{}', allowed: "
                             "particles in front of every tool",
                             described(i), depth, tool.name));
      }
  }

  // Those whose balls overlap along x, from the left.
  std::size_t between_particles() {
    std::vector<std::size_t> order(bodies_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return left_of(i); });
    std::size_t pairs = 0;
    for (std::size_t a = 0; a < order.size(); ++a)
      for (std::size_t b = a + 1; b < order.size(); ++b) {
        if (left_of(order[b]) > poses_[order[a]].at.x + shape(order[a]).reach) break;
        if (!are_near(order[a], order[b])) continue;
        ++pairs;
        pair(std::min(order[a], order[b]), std::max(order[a], order[b]));
      }
    return pairs;
  }

  void throw_if_any() {
    if (!problems_.empty()) throw SceneError(problems_);
  }

 private:
  const RigidShape& shape(std::size_t i) const {
    return shapes_[static_cast<std::size_t>(bodies_[i].particle)];
  }
  double allowed(std::size_t i) const { return touching_tolerance * shape(i).diameter; }
  double left_of(std::size_t i) const { return poses_[i].at.x - shape(i).reach; }

  bool are_near(std::size_t a, std::size_t b) const {
    return length(poses_[a].at - poses_[b].at) < shape(a).reach + shape(b).reach;
  }

  void pair(std::size_t a, std::size_t b) {
    const RigidPair both(shape(a), poses_[a], shape(b), poses_[b]);
    V3 normal = unit(poses_[b].at - poses_[a].at);
    const std::optional<RigidTouch> touch = both.touch(0, normal);
    if (!touch) return;
    const double depth = -both.distance(touch->normal);
    if (depth > std::min(allowed(a), allowed(b)))
      add(b, fmt::format("{} and {} overlap by {:.6g} m, allowed: particles that touch at most",
                         described(a), described(b), depth));
  }

  // m, farthest point of a particle along a direction.
  Vec3 farthest(std::size_t i, const Vec3& direction) const {
    const Turn& turn = poses_[i].turn;
    return bodies_[i].position +
           vector_of(turn * shape(i).support(turned_back(turn, plain(direction))));
  }

  double depth_in(const ToolSpec& tool, std::size_t i) const {
    switch (tool.shape) {
      case ToolSpec::Shape::plane:
        return tool.normal.dot(tool.point - farthest(i, -tool.normal));
      case ToolSpec::Shape::die:
        return depth_in_die(tool, i);
      case ToolSpec::Shape::punch:
        return depth_in_punch(tool, i);
      case ToolSpec::Shape::stl:
        break;
    }
    return 0;
  }

  // Beyond the hole, in the direction in which the particle's centre lies from its axis.
  double depth_in_die(const ToolSpec& die, std::size_t i) const {
    const auto across = [&](const Vec3& p) {
      const Vec3 from = p - die.point;
      return Vec3(from - die.normal.dot(from) * die.normal);
    };
    double deepest = 0;
    const Vec3 first = die.normal.unitOrthogonal(), second = die.normal.cross(first);
    const Vec3 centre = across(bodies_[i].position);
    std::vector<Vec3> directions;
    if (centre.norm() > 0) directions.push_back(centre.normalized());
    constexpr int looks = 16;  // of shapes that are no balls
    for (int k = 0; k < looks && !shape(i).is_ball(); ++k)
      directions.push_back(across(farthest(i, portable::cos(2 * std::numbers::pi * k / looks) * first +
                                                  portable::sin(2 * std::numbers::pi * k / looks) * second))
                               .normalized());
    for (const Vec3& direction : directions)
      deepest = std::max(deepest, across(farthest(i, direction)).norm() - die.diameter / 2);
    return deepest;
  }

  // Behind the lowest point of its face.
  double depth_in_punch(const ToolSpec& punch, std::size_t i) const {
    double lowest = 0;
    for (const Vec2& p : punch.profile) lowest = std::min(lowest, p.y());
    return punch.normal.dot(punch.point - farthest(i, -punch.normal)) + lowest;
  }

  void add(std::size_t i, const std::string& message) {
    if (problems_.size() > most_told) return;
    const BodySpec& body = bodies_[i];
    const bool last = problems_.size() == most_told;
    problems_.push_back({scene_.file_of(body.mark).string(), body.mark.line, body.mark.column, "",
                         last ? "scene" : key_of_body(body),
                         last ? "there are more overlaps, not listed" : message});
  }

  // A packing's particles share its mark, so the mark tells where a particle comes from.
  std::string key_of_body(const BodySpec& body) const {
    for (std::size_t i = 0; i < space_.packings.size(); ++i)
      if (space_.packings[i].mark == body.mark) return fmt::format("packing[{}]", i);
    for (std::size_t i = 0; i < space_.bodies.size(); ++i)
      if (space_.bodies[i].mark == body.mark) return fmt::format("body[{}].position", i);
    return "particle";
  }

  std::string described(std::size_t i) const {
    const Vec3& at = bodies_[i].position;
    return fmt::format("particle {} ('{}' at ({:.6g}, {:.6g}, {:.6g}) m)", i,
                       space_.particles[static_cast<std::size_t>(bodies_[i].particle)].name, at.x(),
                       at.y(), at.z());
  }

  const Scene& scene_;
  const SpaceScene& space_;
  const std::vector<BodySpec>& bodies_;
  std::vector<RigidShape> shapes_;
  std::vector<RigidPose> poses_;
  std::vector<SceneProblem> problems_;
};

}  // namespace

std::size_t check_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies) {
  SpaceOverlaps search(scene, bodies);
  search.with_tools();
  const std::size_t pairs = search.between_particles();
  search.throw_if_any();
  return pairs;
}

}  // namespace pulvis::space
