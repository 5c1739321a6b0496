#include "scenes/afm_simulation.hpp"

#include <algorithm>

#include "components/solid.hpp"
#include "scenes/afm_scene.hpp"

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

Calibration AfmSimulation::calibrate_here() {
  solver_->linearise();
  const Calibration c = pulvis::calibrate(scene_, model_, *solver_);
  model_.normal_stiffness = c.normal_stiffness;
  stiffest_ = std::max({c.normal_stiffness, c.lateral_stiffness, c.longitudinal_stiffness});
  return c;
}

bool AfmSimulation::run(const AfmProgramme::Record& record, AfmPosition& position,
                        const std::function<void(World&)>& restore) {
  bool done = false;
  workers_.run([&] {
    if (model_.normal_stiffness == 0) calibrate_here();
    place_target(scene_, model_, stiffest_);
    if (restore) restore(world());
    done = AfmProgramme(scene_, model_, *solver_, position, record).run();
  });
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
    if (report.converged) solver_->remember();
  });
  return report;
}

}  // namespace pulvis
