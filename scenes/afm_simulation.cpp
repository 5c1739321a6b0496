#include "scenes/afm_simulation.hpp"

#include <algorithm>

#include "components/solid.hpp"

namespace pulvis {

AfmSimulation::AfmSimulation(const Scene& scene, int threads)
    : scene_(scene), model_(build_afm(scene)), workers_(threads) {
  workers_.run([&] { solver_ = std::make_unique<StaticSolver>(*model_.world); });
}

AfmSimulation::~AfmSimulation() {
  workers_.run([&] { solver_.reset(); });
}

Calibration AfmSimulation::calibrate() {
  Calibration result;
  workers_.run([&] {
    solver_->linearise();
    result = pulvis::calibrate(scene_, model_, *solver_);
  });
  return result;
}

std::vector<double> AfmSimulation::unit_displacements(const Vec3& direction) {
  return pulvis::unit_displacements(model_, *solver_, direction);
}

NewtonReport AfmSimulation::load_tip(const Vec3& force, const NewtonSettings& settings) {
  double* applied = world().column<AppliedForce>().values();
  std::fill(applied, applied + 3 * model_.nodes, 0.0);
  for (const auto& support : model_.end)
    for (int k = 0; k < 3; ++k) applied[3 * support.node + k] += support.weight * force[k];
  NewtonReport report;
  workers_.run([&] { report = solver_->equilibrate(settings); });
  return report;
}

}  // namespace pulvis
