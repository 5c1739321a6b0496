#include "scenes/lever/afm_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "components/solid.hpp"
#include "engine/run_failure.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {

AfmSimulation::AfmSimulation(const Scene& scene, int threads)
    : scene_(scene), model_(build_afm(scene)), workers_(threads) {
  if (!scene.afm->actions.empty()) add_probe(scene, model_);
  workers_.run([&] { solver_ = std::make_unique<StaticSolver>(*model_.world); });
}

AfmSimulation::~AfmSimulation() {
  workers_.run([&] { solver_.reset(); });
}

Calibration AfmSimulation::calibrate() {
  Calibration result;
  workers_.run([&] { result = calibrate_here(); });
  return result;
}

// Where double precision does not suffice, long double is tried; if that fails, there is no result.
Calibration AfmSimulation::calibrate_here() {
  constexpr double in_double = 1e-9, in_long_double = 1e-6;  // -, of the solutions
  const auto answer = [&] {
    solver_->linearise();
    return pulvis::calibrate(scene_, model_, *solver_);
  };
  Calibration c = answer();
  if (!solver_->in_extended_precision() && !c.good(in_double)) {
    solver_->extend_precision();
    c = answer();
  }
  if (c.extended && !c.good(in_long_double))
    throw RunFailure(
        fmt::format("calibration: the lever's stiffness matrix is too ill-conditioned for long "
                    "double: the relative error of its response to a force is {:.2g}{}, allowed: "
                    "{:g}; the lever is {:.3g} times longer than thick, and the stiffest material "
                    "is {:.3g} times stiffer than that of the lever",
                    c.error, c.stable ? "" : ", and the stiffness is not positive", in_long_double,
                    scene_.afm->lever.length / scene_.afm->lever.thickness, stiffest_material()));
  model_.normal_stiffness = c.normal_stiffness;
  stiffest_ = std::max({c.normal_stiffness, c.lateral_stiffness, c.longitudinal_stiffness});
  return c;
}

double AfmSimulation::stiffest_material() const {
  const auto& lever = scene_.materials[static_cast<std::size_t>(scene_.afm->lever.material)];
  return std::ranges::max(scene_.materials, {}, &MaterialSpec::youngs_modulus).youngs_modulus /
         lever.youngs_modulus;
}

void AfmSimulation::begin(const std::function<void(World&)>& restore) {
  workers_.run([&] {
    if (model_.normal_stiffness == 0) calibrate_here();
    place_target(scene_, model_, stiffest_);
    if (restore) restore(world());
  });
}

bool AfmSimulation::go_on(const AfmProgramme::Record& record, AfmPosition& position) {
  bool done = false;
  workers_.run([&] { done = AfmProgramme(scene_, model_, *solver_, position, record).run(); });
  return done;
}

std::vector<double> AfmSimulation::unit_displacements(const Vec3& direction) {
  std::vector<double> u;
  workers_.run([&] { u = pulvis::unit_displacements(model_, *solver_, direction); });
  return u;
}

NewtonReport AfmSimulation::load_tip(const Vec3& force, const NewtonSettings& settings) {
  double* applied = world().column<AppliedForce>().values();
  std::fill(applied, applied + 3 * model_.nodes, 0.0);
  for (const auto& support : model_.end)
    for (int k = 0; k < 3; ++k) applied[3 * support.node + k] += support.weight * force[k];
  NewtonReport report;
  workers_.run([&] {
    report = solver_->equilibrate(settings);
    if (report.converged) solver_->commit();
  });
  return report;
}

}  // namespace pulvis
