// A running AFM scene: its solid, its threads, its solver.
#pragma once

#include "engine/workers.hpp"
#include "scenes/lever/afm_calibration.hpp"
#include "scenes/lever/afm_programme.hpp"
#include "systems/lever/static_solver.hpp"

namespace pulvis {

class AfmSimulation {
 public:
  explicit AfmSimulation(const Scene& scene, int threads = 1);
  ~AfmSimulation();

  World& world() { return *model_.world; }
  AfmModel& model() { return model_; }
  const GraphPlan& plan() const { return solver_->plan(); }

  // Throws RunFailure where the lever's response does not converge.
  Calibration calibrate();
  // Displacements [3 nodes] due to 1 N at the tip's end; after calibrate().
  std::vector<double> unit_displacements(const Vec3& direction);
  // Calibrates and places the target under the tip. `restore` then loads a checkpoint's state into the world.
  void begin(const std::function<void(World&)>& restore = {});
  // After begin(): runs the scene's actions from `position` on, with the world in that state; see AfmProgramme. When
  // `record` has ended it, it may be called again.
  bool go_on(const AfmProgramme::Record& record, AfmPosition& position);
  bool run(const AfmProgramme::Record& record) {
    AfmPosition beginning;
    begin();
    return go_on(record, beginning);
  }
  // Equilibrium under a dead load at the tip's end, from the current state.
  NewtonReport load_tip(const Vec3& force, const NewtonSettings& settings = {});

 private:
  Calibration calibrate_here();      // inside the workers
  double stiffest_material() const;  // -, Young's modulus over the lever's

  const Scene& scene_;
  AfmModel model_;
  Workers workers_;
  std::unique_ptr<StaticSolver> solver_;
  double stiffest_ = 0;  // N/m, of the tip's end
};

}  // namespace pulvis
