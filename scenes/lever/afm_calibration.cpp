#include "scenes/lever/afm_calibration.hpp"
#include "scenes/spec/afm_scene.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "components/solid.hpp"
#include "scenes/lever/linear_response.hpp"

namespace pulvis {
namespace {

// Slopes of a linear response: small displacements, regardless of the size of 1 N.
Slopes linear_slopes(const AfmModel& model, const std::vector<SlopeGauge>& gauges,
                     std::vector<double> displacement) {
  constexpr double small = 1e-9;  // rad
  double largest = 0;
  for (const SlopeGauge& gauge : gauges)
    largest = std::max({largest, read(gauge.along, displacement.data()).norm(),
                        read(gauge.across, displacement.data()).norm()});
  if (largest == 0) return {};
  for (double& u : displacement) u *= small / largest;
  const Slopes s = slopes(model, gauges, displacement.data());
  return {s.normal * largest / small, s.lateral * largest / small};
}

LinearResponse unit_response(AfmModel& model, StaticSolver& solver, const Vec3& direction) {
  std::vector<double> force(3 * model.nodes);
  for (const auto& support : model.end)
    for (int k = 0; k < 3; ++k)
      force[static_cast<std::size_t>(3 * support.node + k)] += support.weight * direction[k];
  return linear_response(*model.world, solver, force);
}

UnitResponse respond(AfmModel& model, StaticSolver& solver, const Vec3& direction) {
  const LinearResponse answer = unit_response(model, solver, direction);
  const auto& [u, held] = std::tie(answer.displacements, answer.forces);
  UnitResponse r;
  r.error = answer.correction + answer.energy_error;
  r.end = read(model.end, u.data());
  r.foot = read(model.foot, u.data());
  r.spot = linear_slopes(model, model.spot, u);
  r.at_foot = linear_slopes(model, {model.foot_slope}, u);
  const auto& mesh = model.world->resource<SolidMesh>();
  const double* x = model.world->column<ReferencePosition>().values();
  r.clamp_force.setZero();
  r.clamp_moment.setZero();
  for (std::size_t n = 0; n < model.nodes; ++n) {
    if (!mesh.supports_of(static_cast<int>(n)).empty()) continue;
    const Vec3 force(held[3 * n], held[3 * n + 1], held[3 * n + 2]);
    r.clamp_force += force;
    r.clamp_moment += Vec3(x[3 * n], x[3 * n + 1], x[3 * n + 2]).cross(force);
  }
  return r;
}

}  // namespace

std::vector<double> unit_displacements(AfmModel& model, StaticSolver& solver,
                                       const Vec3& direction) {
  return unit_response(model, solver, direction).displacements;
}

Calibration calibrate(const Scene& scene, AfmModel& model, StaticSolver& solver) {
  const AfmScene& afm = *scene.afm;
  Calibration c;
  c.normal = respond(model, solver, Vec3::UnitZ());
  c.lateral = respond(model, solver, Vec3::UnitY());
  c.longitudinal = respond(model, solver, Vec3::UnitX());
  c.arm = tip_height(afm.tip) + 0.5 * afm.lever.thickness;
  c.normal_stiffness = 1 / c.normal.end.z();
  c.lateral_stiffness = 1 / c.lateral.end.y();
  c.longitudinal_stiffness = 1 / c.longitudinal.end.x();
  // A force along +y below the foot rotates it about +x: its +y side moves up.
  const double twist = c.lateral.at_foot.lateral;
  c.torsional_stiffness = c.arm / twist;
  c.bending_share = c.lateral.foot.y() / c.lateral.end.y();
  c.twist_share = c.arm * twist / c.lateral.end.y();
  c.tip_share = 1 - c.bending_share - c.twist_share;
  c.normal_invols = c.normal.end.z() / (afm.detector.normal_gain * c.normal.spot.normal);
  c.lateral_invols = c.lateral.end.y() / (afm.detector.lateral_gain * c.lateral.spot.lateral);
  for (const auto& [r, f] : {std::pair{&c.normal, Vec3(Vec3::UnitZ())},
                             {&c.lateral, Vec3(Vec3::UnitY())},
                             {&c.longitudinal, Vec3(Vec3::UnitX())}})
    c.imbalance = std::max(c.imbalance, (r->clamp_force + f).norm());
  for (const UnitResponse* r : {&c.normal, &c.lateral, &c.longitudinal})
    c.error = std::isnan(r->error) ? r->error : std::max(c.error, r->error);
  c.extended = solver.in_extended_precision();
  c.stable = solver.stable();
  c.closed_forms = closed_forms(scene);
  return c;
}

}  // namespace pulvis
