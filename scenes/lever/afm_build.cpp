#include "scenes/lever/afm_build.hpp"
#include "engine/portable_math.hpp"
#include "scenes/spec/afm_scene.hpp"
#include "scenes/spec/rotation.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "scenes/lever/adhesion.hpp"
#include "scenes/lever/mesh/meshed_lever.hpp"
#include "scenes/lever/mesh/surface_slope.hpp"

namespace pulvis {
namespace {

// Of the middle plane: differences over half an element of the foot to both sides, or to the one that exists.
Gauge difference(const LeverMesh& lever, const Vec2& point, const Vec2& step) {
  auto ahead = lever.on_middle(point + step), behind = lever.on_middle(point - step);
  const double distance = (ahead ? step.norm() : 0) + (behind ? step.norm() : 0);
  if (!ahead) ahead = lever.on_middle(point);
  if (!behind) behind = lever.on_middle(point);
  Gauge gauge = ahead->gauge;
  for (auto& support : gauge) support.weight /= distance;
  for (const auto& support : behind->gauge)
    gauge.push_back({support.node, -support.weight / distance});
  return gauge;
}

SlopeGauge slope_of_middle(const LeverMesh& lever, const LeverSpec& spec, const Vec2& point) {
  using Shape = LeverSpec::Shape;
  const double step = spec.shape == Shape::mesh   ? spec.thickness
                      : spec.shape == Shape::beam ? 0.05 * spec.width
                                                  : 0.05 * spec.arm_width;
  return {difference(lever, point, {step, 0}), difference(lever, point, {0, step})};
}

// A uniformly bright spot: its centre, and a ring of eight points that represents the rest (exact for
// slopes that vary linearly or quadratically over it: radius r / sqrt 2).
std::vector<SlopeGauge> laser_spot(const Scene& scene, const LeverMesh& lever) {
  const LaserSpec& laser = scene.afm->laser;
  const Vec2 axis = tip_axis(scene.afm->lever, scene.afm->tip);
  const Vec2 middle(laser.position.value_or(axis.x()), laser.offset);
  const SurfaceSlope back(lever.levels.back());
  const auto at = [&](const Vec2& point) {
    const auto slope = back.at(point).value();  // afm_checks refuses spots beside the lever
    return SlopeGauge{slope.along, slope.across};
  };
  if (laser.radius == 0) return {at(middle)};
  std::vector<SlopeGauge> spot;
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.25 * std::numbers::pi * (i + 0.5), r = laser.radius / std::sqrt(2.0);
    spot.push_back(at(middle + r * Vec2(portable::cos(angle), portable::sin(angle))));
  }
  return spot;
}

// The node of the tip's end nearest to its centre.
int middle_node(const SolidDraft& draft, const Gauge& end) {
  Vec3 middle = Vec3::Zero();
  for (const auto& s : end) middle += s.weight * draft.nodes[static_cast<std::size_t>(s.node)];
  int nearest = end.front().node;
  const auto distance = [&](int n) {
    return (draft.nodes[static_cast<std::size_t>(n)] - middle).norm();
  };
  for (const auto& s : end)
    if (distance(s.node) < distance(nearest)) nearest = s.node;
  return nearest;
}

std::array<SolidMaterial, 4> part_materials(const Scene& scene) {
  const AfmScene& afm = *scene.afm;
  const auto of = [&](int material) {
    return solid_material(scene.materials[static_cast<std::size_t>(material)]);
  };
  return {of(afm.lever.material), of(afm.lever.coating.value_or(afm.lever.material)),
          of(afm.tip.material), of(afm.tip.glue.value_or(afm.tip.material))};
}

}  // namespace

AfmModel build_afm(const Scene& scene) {
  const AfmScene& afm = *scene.afm;
  AfmModel model;
  SolidDraft draft;
  const std::optional<FootPlan> foot = foot_plan(afm.lever, afm.tip);
  const LeverMesh lever = afm.lever.solid ? add_meshed_lever(draft, afm.lever)
                                          : add_lever(draft, afm.lever, lever_plan(afm.lever, foot),
                                                      foot ? foot->edge : afm.lever.thickness);
  // Built flat, then rotated: the chip's tilt lowers the lever's end.
  const Eigen::Matrix3d turn = rotation_about_y(afm.lever.tilt);
  model.tip = add_tip(draft, afm.lever, lever, afm.tip, adhesive_normal(scene, turn));
  model.end = model.tip.end;
  model.contact_node = middle_node(draft, model.end);
  const Vec2 axis = tip_axis(afm.lever, afm.tip);
  model.foot = lever.on_middle(axis)->gauge;
  model.foot_slope = slope_of_middle(lever, afm.lever, axis);
  model.spot = laser_spot(scene, lever);
  for (Vec3& x : draft.nodes) x = turn * x;
  model.axis = turn.col(0);
  model.side = turn.col(1);
  model.up = turn.col(2);
  model.nodes = draft.nodes.size();
  model.elements = draft.hexahedra.size() + draft.tetrahedra.size();
  model.world = finish_solid(draft, part_materials(scene));
  return model;
}

Vec3 clamp_force(const AfmModel& model) {
  const auto& mesh = model.world->resource<SolidMesh>();
  const double* force = model.world->column<SolidForce>().values();
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < model.nodes; ++n)
    if (mesh.supports_of(static_cast<int>(n)).empty()) sum += Vec3(force + 3 * n);
  return sum;
}

double elastic_energy(const AfmModel& model) {
  double sum = 0;
  const auto add = [&](const auto& energy) {
    for (std::size_t e = 0; e < energy.table.rows; ++e) sum += energy.values()[e];
  };
  add(model.world->column<ElementEnergy>());
  if (model.world->has<TetrahedronEnergy>()) add(model.world->column<TetrahedronEnergy>());
  return sum;
}

Vec3 read(const Gauge& gauge, const double* field) {
  Vec3 sum = Vec3::Zero();
  for (const auto& support : gauge)
    for (int k = 0; k < 3; ++k) sum[k] += support.weight * field[3 * support.node + k];
  return sum;
}

Slopes slopes(const AfmModel& model, const std::vector<SlopeGauge>& gauges,
              const double* displacement) {
  Slopes mean;
  for (const SlopeGauge& gauge : gauges) {
    const Vec3 along = model.axis + read(gauge.along, displacement);
    const Vec3 across = model.side + read(gauge.across, displacement);
    mean.normal += portable::atan2(along.dot(model.up), along.dot(model.axis));
    mean.lateral += portable::atan2(across.dot(model.up), across.dot(model.side));
  }
  const auto count = static_cast<double>(gauges.size());
  return {mean.normal / count, mean.lateral / count};
}

}  // namespace pulvis
