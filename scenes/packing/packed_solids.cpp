#include "scenes/packing/packed_solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/packing/solids/widths.hpp"

namespace pulvis::space {
namespace {

double lowest_place(const std::vector<std::array<Vec3, 3>>& triangles) {
  double lowest = std::numeric_limits<double>::max();
  for (const auto& triangle : triangles)
    for (const Vec3& corner : triangle) lowest = std::min(lowest, corner.z());
  return lowest;
}

// m, how far below its point a tool that rests on the packing reaches.
double foremost_place(const ToolSpec& tool) {
  if (!tool.triangles.empty()) return -lowest_place(tool.triangles);
  if (tool.shape != ToolSpec::Shape::punch || tool.profile.empty() || !(tool.normal.z() < 0))
    return 0;
  return std::ranges::max(tool.profile, {}, [](const Vec2& place) { return place.y(); }).y();
}

}  // namespace

void PackedSolids::resize(ParticleSpec& particle, double factor) {
  particle.shape = scaled(particle.shape, factor);
}

ParticleMeasure PackedSolids::measure(const ParticleSpec& particle, bool one_size) {
  return {one_size ? 1 : widths_of(particle.shape).middle, volume_of(particle.shape)};
}

double PackedSolids::mean_diameter(double content, int count) {
  return portable::cbrt(6 / std::numbers::pi * content / count);
}

RigidShape PackedSolids::shape(const ParticleSpec& particle, double unit) {
  return contact_shape(particle, unit);
}

double PackedSolids::least_width(const ParticleSpec& particle) {
  return widths_of(particle.shape).least;
}

Container PackedSolids::container(const Scene& scene, const ContainerSpec& given, double unit) {
  return {given.kind, given.width / unit, given.depth / unit, given.diameter / 2 / unit,
          scene.cell.has_value()};
}

BodySpec PackedSolids::placed(const Scene& scene, const ContainerSpec& given, const RigidShape&,
                              const RigidPose& pose, double height, double unit) {
  const Container in = container(scene, given, unit);
  V3 at = pose.at;
  if (in.periodic) {
    const auto periods = [](double x, double size) {
      return -static_cast<std::int32_t>(std::floor(x / size));
    };
    at = at + shift_of(in, height,
                       {periods(at.x, in.width), periods(at.y, in.depth), periods(at.z, height)});
  }
  BodySpec body;
  body.position = given.corner + unit * Vec3(at.x, at.y, at.z);
  body.rotation = Rotation(pose.turn.w, pose.turn.x, pose.turn.y, pose.turn.z);
  return body;
}

void PackedSolids::put_on(ToolSpec& tool, double top) {
  tool.point.z() = top + foremost_place(tool);
}

double PackedSolids::Reach::upwards(const BodySpec& body) const {
  const V3 upward = turned_back(turn_of(body.rotation), {0, 0, 1});
  return dot(shape_.support(upward), upward);
}

}  // namespace pulvis::space
