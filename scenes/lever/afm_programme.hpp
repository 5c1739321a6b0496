// What the scanner does, increment by increment: an equilibrium of lever, probe and target at each.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/files/record.hpp"
#include "scenes/lever/afm_build.hpp"
#include "scenes/lever/equilibrium_trail.hpp"

namespace pulvis {

// Series of a programme's history, in the order of AfmProgramme's rows.
std::vector<SeriesInfo> afm_series();

// Puts the target under the tip, so that it just touches, with its penalties; the lever's stiffness must
// have been linearised. Before the solver is built: add_probe().
void add_probe(const Scene& scene, AfmModel& model);
void place_target(const Scene& scene, AfmModel& model, double stiffness);

// Where a programme stands: enough, with the world, to go on.
struct AfmPosition {
  std::int64_t told = 0;  // rows of the history so far, the one before the first increment included
  double from = 0;        // N, vertical force when the press to a force began
  double released = 0;    // J, by the probe's jumps until now
  double set_point = 0;   // N, of the last increment
  EquilibriumTrail trail;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(told, from, released, set_point, trail);
  }
};

class AfmProgramme {
 public:
  // `record` gets time (in actions) and a row of the history after every increment; false ends the run.
  using Record = std::function<bool(double time, const std::vector<double>& row)>;
  // `position` is kept up to date; it need not be the beginning's.
  AfmProgramme(const Scene& scene, AfmModel& model, StaticSolver& solver, AfmPosition& position,
               Record record)
      : scene_(scene),
        model_(model),
        solver_(solver),
        position_(position),
        record_(std::move(record)) {}

  // False when it was interrupted. Throws RunFailure where an increment cannot be made.
  bool run();

 private:
  bool press(const ActionSpec& action, double sign);
  bool press_to_force(const ActionSpec& action);
  bool scan(const ActionSpec& action);
  bool raster(const ActionSpec& action);
  bool traverse(const std::array<double, 3>& travel, int increments, bool servo);
  // Moves the target; where no equilibrium is found, in halves.
  void advance(const std::array<double, 3>& travel, bool servo, int depth);
  // An equilibrium for the target where it is, from where the last increments lead, if they lead anywhere.
  NewtonReport equilibrium(const NewtonSettings& settings, const IncrementStep& step);
  // Friction that no force along the traverse overcomes, since it grows with the force: stops the run.
  void refuse_lock(const std::array<double, 3>& travel) const;
  bool tell();
  bool skip();  // the increment has been made before
  double vertical_force() const;

  const Scene& scene_;
  AfmModel& model_;
  StaticSolver& solver_;
  AfmPosition& position_;
  Record record_;
  std::int64_t to_skip_ = 0;     // increments
  double time_ = 0, share_ = 1;  // of the present increment, in actions
  int iterations_ = 0;           // of the last increment, its cuts included
  const char* doing_ = "";
};

}  // namespace pulvis
