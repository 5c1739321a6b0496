// What the scanner does, increment by increment: an equilibrium of lever, probe and target at each.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/record.hpp"
#include "scenes/afm_build.hpp"
#include "systems/static_solver.hpp"

namespace pulvis {

// Series of a programme's history, in the order of AfmProgramme's rows.
std::vector<SeriesInfo> afm_series();

// Puts the target under the tip, so that it just touches, with its penalties; the lever's stiffness must
// have been linearised. Before the solver is built: add_probe().
void add_probe(const Scene& scene, AfmModel& model);
void place_target(const Scene& scene, AfmModel& model, double stiffness);

class AfmProgramme {
 public:
  // `record` gets time (in actions) and a row of the history after every increment; false ends the run.
  using Record = std::function<bool(double time, const std::vector<double>& row)>;
  AfmProgramme(const Scene& scene, AfmModel& model, StaticSolver& solver, Record record)
      : scene_(scene), model_(model), solver_(solver), record_(std::move(record)) {}

  // False when it was interrupted. Throws RunFailure where an increment cannot be made.
  bool run();

 private:
  bool press(const ActionSpec& action, double sign);
  bool press_to_force(const ActionSpec& action);
  bool scan(const ActionSpec& action);
  bool raster(const ActionSpec& action);
  bool way(const std::array<double, 3>& travel, int increments, bool servo);
  // Moves the target; where no equilibrium is found, in halves.
  void advance(const std::array<double, 3>& travel, bool servo, int depth);
  // Friction that no force along the way overcomes, since it grows with the force: stops the run.
  void refuse_lock(const std::array<double, 3>& travel) const;
  bool tell();
  double vertical_force() const;

  const Scene& scene_;
  AfmModel& model_;
  StaticSolver& solver_;
  Record record_;
  double time_ = 0, share_ = 1;  // of the present increment, in actions
  int iterations_ = 0;           // of the last increment, its cuts included
  double released_ = 0;          // J, by the probe's jumps until now
  const char* doing_ = "";
};

}  // namespace pulvis
