#include "scenes/packing/packed_outlines.hpp"

#include <cmath>
#include <numbers>

#include "scenes/outlines/outline.hpp"
#include "scenes/outlines/portable.hpp"
#include "scenes/outlines/scaled_outline.hpp"

namespace pulvis {
namespace {

using portable::V2;

constexpr double outline_deviation = 1e-3;  // of a particle's size, unless it is a rounded polygon

// Into the cell.
V2 home(const V2& at, double width, double height) {
  return {at.x - std::floor(at.x / width) * width, at.y - std::floor(at.y / height) * height};
}

}  // namespace

void PackedOutlines::resize(ParticleSpec& particle, double factor) {
  particle.outline = scaled(particle.outline, factor);
}

ParticleMeasure PackedOutlines::measure(const ParticleSpec& particle, bool one_size) {
  return {one_size ? 1 : least_width(particle), outline_area(particle.outline)};
}

double PackedOutlines::mean_diameter(double content, int count) {
  return 2 * std::sqrt(content / count / std::numbers::pi);
}

RigidShape PackedOutlines::shape(const ParticleSpec& particle, double unit) {
  return rigid_shape(particle.outline, unit,
                     outline_deviation * std::sqrt(outline_area(particle.outline)));
}

double PackedOutlines::least_width(const ParticleSpec& particle) {
  const double length = std::sqrt(outline_area(particle.outline));
  return length * rigid_shape(particle.outline, length, length / 1000).min_width;
}

Container PackedOutlines::container(const Scene& scene, const ContainerSpec& given, double unit) {
  return {given.width / unit, scene.cell.has_value()};
}

BodySpec PackedOutlines::placed(const Scene& scene, const ContainerSpec& given,
                                const RigidShape& shape, RigidPose pose, double height,
                                double unit) {
  const Container in = container(scene, given, unit);
  if (in.periodic) pose.at = home(pose.at, in.width, height);
  const double angle = scene.cell ? scene.cell->angle : 0;
  V2 at = pose.at - pose.turn * shape.centroid;
  if (angle != 0) at = portable::Turn{portable::cos(angle), portable::sin(angle)} * at;
  BodySpec body;
  body.position = given.corner + unit * Vec3(at.x, at.y, 0);
  body.angle = portable::atan2(pose.turn.s, pose.turn.c) + angle;
  return body;
}

void PackedOutlines::put_on(ToolSpec& tool, double top) {
  const double rise = top - tool.point.y();
  for (Vec2& p : tool.points) p.y() += rise;  // for a drawn one
  tool.point.y() += rise;
}

}  // namespace pulvis
