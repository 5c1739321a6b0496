#include "scenes/checks/solids/solid_overlaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "scenes/meshes/hexahedra/directions.hpp"
#include "scenes/meshes/hexahedra/star_surface.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/packing/solids/container.hpp"
#include "scenes/packing/solids/near_pairs.hpp"
#include "scenes/tools/surfaces/tool_depth.hpp"
#include "scenes/tools/surfaces/tool_shapes.hpp"

namespace pulvis::space {
namespace {

constexpr double exact_face = 1e-11;  // mean diameters
// Relative to the smaller particle's size: error of the search for the separating translation of non-spherical bodies.
constexpr double search_tolerance = 1e-7;

// The smallest rotation that makes the unit vector `axis` the z axis.
Turn turn_to_z(const Vec3& axis) {
  const double w = 1 + axis.z();
  if (w < 1e-12) return {0, 1, 0, 0};
  const double norm = 1 / std::sqrt(w * w + axis.y() * axis.y() + axis.x() * axis.x());
  return {norm * w, norm * axis.y(), -norm * axis.x(), 0};
}

class BodyOverlaps {
 public:
  using ShapeOf = RigidShape(const ParticleSpec&, double unit);

  BodyOverlaps(const Scene& scene, const std::vector<BodySpec>& bodies, ShapeOf& shape_of)
      : scene_(scene),
        bodies_(bodies),
        tools_(tool_shapes(scene_)),
        points_(scene_.particles.size()) {
    double sum = 0;
    for (const ParticleSpec& particle : scene_.particles) sum += diameter_of(particle.shape);
    unit_ = sum / static_cast<double>(scene_.particles.size());
    for (const ParticleSpec& particle : scene_.particles)
      shapes_.push_back(shape_of(particle, unit_));
    for (const BodySpec& body : bodies)
      poses_.push_back({vector_of(body.position / unit_), turn_of(body.rotation)});
  }

  std::vector<Overlap> between_particles() {
    std::vector<Ball> balls;
    for (std::size_t i = 0; i < poses_.size(); ++i) balls.push_back({poses_[i].at, shape(i).reach});
    auto pairs = near_pairs(balls, 0);
    pairs_ = pairs.size();
    std::ranges::sort(pairs, {}, [](const auto& p) { return std::pair(p.second, p.first); });
    std::vector<Overlap> found;
    for (const auto& [a, b] : pairs) {
      const auto i = static_cast<std::size_t>(b), k = static_cast<std::size_t>(a);
      const double depth = depth_of(i, k);
      if (depth > std::min(tolerance(i), tolerance(k))) found.push_back({i, k, depth * unit_});
    }
    return found;
  }
  std::size_t pairs() const { return pairs_; }

  std::vector<Overlap> with_tool(std::size_t number) {
    std::vector<Overlap> found;
    const ToolSpec& tool = scene_.tools[number];
    if (tool.shape == ToolSpec::Shape::constraint) return found;
    const bool solid = is_solid(tool);
    ToolDepth in_tool(tool, tools_.of_tool[number]);
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const double depth =
          solid ? depth_in(in_tool, i) / unit_ : depth_behind(tool, tool.normal, i);
      if (depth > tolerance(i)) found.push_back({i, number, depth * unit_});
    }
    return found;
  }

  // If flipped, the plane would have every particle in front of it.
  bool is_reversed(const ToolSpec& tool) const {
    if (tool.shape != ToolSpec::Shape::plane) return false;
    for (std::size_t i = 0; i < poses_.size(); ++i)
      if (depth_behind(tool, -tool.normal, i) > tolerance(i)) return false;
    return true;
  }

 private:
  const RigidShape& shape(std::size_t i) const {
    return shapes_[static_cast<std::size_t>(bodies_[i].particle)];
  }
  double tolerance(std::size_t i) const {
    return (shape(i).is_ball() ? touching_tolerance : search_tolerance) * shape(i).diameter;
  }

  double depth_of(std::size_t i, std::size_t k) const {
    const RigidPair pair(shape(i), poses_[i], shape(k), poses_[k]);
    V3 normal{0, 0, 1};
    const auto touch = pair.touch(0, normal, exact_face);
    return touch ? -pair.distance(touch->normal) : 0;
  }

  // For a plane or a die without a mouth; in diameters.
  double depth_behind(const ToolSpec& tool, const Vec3& along, std::size_t i) const {
    const V3 normal = vector_of(along), at = poses_[i].at - vector_of(tool.point / unit_);
    if (tool.shape == ToolSpec::Shape::plane) {
      const V3 deepest = poses_[i].turn * shape(i).support(turned_back(poses_[i].turn, -normal));
      return -dot(normal, at + deepest);
    }
    const Turn turn = turn_to_z(along);
    const auto touch = round_wall_touch(tool.diameter / 2 / unit_, shape(i),
                                        {turn * at, turn * poses_[i].turn}, 0);
    return touch ? -touch->gap : 0;
  }

  // m, exact for a sphere; for other shapes, from points all over their surface and the farthest point in the direction
  // into the tool.
  double depth_in(ToolDepth& tool, std::size_t i) {
    const BodySpec& body = bodies_[i];
    const double reach = shape(i).reach * unit_;
    tool.look_about(body.position, reach);
    const ToolDepth::Place centre = tool.at(body.position);
    if (shape(i).is_ball() || centre.depth < -reach) return centre.depth + reach;
    const Turn& turn = poses_[i].turn;
    const V3 foremost = turn * shape(i).support(turned_back(turn, vector_of(-centre.out)));
    const auto depth_at = [&](const Vec3& from_centre) {
      return tool.at(body.position + from_centre).depth;
    };
    double depth = depth_at(unit_ * Vec3(foremost.x, foremost.y, foremost.z));
    const Eigen::Matrix3d rotation = body.rotation.toRotationMatrix();
    for (const Vec3& point : surface_points(body.particle))
      depth = std::max(depth, depth_at(rotation * point));
    return depth;
  }

  const std::vector<Vec3>& surface_points(int particle) {
    constexpr int cells = 7;  // along the edge of a cube of directions
    std::vector<Vec3>& points = points_[static_cast<std::size_t>(particle)];
    if (points.empty()) {
      const auto surface = star_surface(scene_.particles[static_cast<std::size_t>(particle)].shape);
      for (const Direction& d : directions(cells)) points.push_back(surface->point(d.unit));
    }
    return points;
  }

  const Scene& scene_;
  const std::vector<BodySpec>& bodies_;
  ToolShapes tools_;
  std::vector<std::vector<Vec3>> points_;  // m, on the classes' surfaces, empty until needed
  double unit_ = 1;                        // m
  std::vector<RigidShape> shapes_;
  std::vector<RigidPose> poses_;
  std::size_t pairs_ = 0;
};

RigidShape true_shape(const ParticleSpec& particle, double unit) {
  return rigid_shape(particle.shape, unit);
}

}  // namespace

Overlaps solid_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies) {
  BodyOverlaps search(scene, bodies, true_shape);
  Overlaps found{search.between_particles(), {}, {}, search.pairs()};
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const std::vector<Overlap> of_tool = search.with_tool(t);
    found.with_tools.insert(found.with_tools.end(), of_tool.begin(), of_tool.end());
    found.reversed.push_back(!of_tool.empty() && search.is_reversed(scene.tools[t]));
  }
  return found;
}

std::vector<std::string> contact_overlap_warnings(const Scene& scene,
                                                  const std::vector<BodySpec>& bodies) {
  const auto bulges = [](const ParticleSpec& particle) {
    return contact_shape(particle, 1).radius > rigid_shape(particle.shape, 1).radius;
  };
  if (bodies.empty() || std::ranges::none_of(scene.particles, bulges)) return {};
  BodyOverlaps search(scene, bodies, contact_shape);
  std::size_t count = 0;
  double deepest = 0;
  std::string where;
  const auto see = [&](const std::vector<Overlap>& overlaps, const auto& name_of) {
    count += overlaps.size();
    for (const Overlap& overlap : overlaps) {
      if (overlap.depth <= deepest) continue;
      deepest = overlap.depth;
      where = fmt::format("particle {} and {}", overlap.particle, name_of(overlap.other));
    }
  };
  see(search.between_particles(), [](std::size_t i) { return fmt::format("particle {}", i); });
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    see(search.with_tool(t),
        [&](std::size_t tool) { return fmt::format("tool '{}'", scene.tools[tool].name); });
  if (count == 0) return {};
  return {fmt::format(
      "the contact surfaces bulge out beyond the shapes: at the start {}, by up to {:.3g} m ({}), "
      "and push each other apart where no initial bond holds them; leave larger gaps, or use more "
      "divisions",
      count == 1 ? "two overlap" : fmt::format("they overlap in {} places", count), deepest,
      where)};
}

}  // namespace pulvis::space
