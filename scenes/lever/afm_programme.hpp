// The scanner's motion, increment by increment: lever, probe and target reach equilibrium in each.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "scenes/lever/afm_build.hpp"
#include "scenes/lever/equilibrium_trail.hpp"

namespace pulvis {

// Places the target under the tip, just touching, with its penalties; the lever's stiffness must
// have been linearised. add_probe() must be called before the solver is built.
void add_probe(const Scene& scene, AfmModel& model);
void place_target(const Scene& scene, AfmModel& model, double stiffness);

// Progress of a programme: enough, together with the world, to continue.
struct AfmPosition {
  std::int64_t told = 0;  // history rows so far, including the one before the first increment
  double from = 0;        // N, vertical force when the press to a force began
  double released = 0;    // J, released by jumps of the probe so far
  double pulling = 0;     // J, energy/pulling so far
  double set_point = 0;   // N, of the last increment
  EquilibriumTrail trail;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(told, from, released, pulling, set_point, trail);
  }
};

class AfmProgramme {
 public:
  // `record` gets time (in actions) and a row of the history after every increment; false ends the run.
  using Record = std::function<bool(double time, const std::vector<double>& row)>;
  // `position` is kept up to date; it need not be at the beginning.
  AfmProgramme(const Scene& scene, AfmModel& model, StaticSolver& solver, AfmPosition& position,
               Record record)
      : scene_(scene),
        model_(model),
        solver_(solver),
        position_(position),
        record_(std::move(record)) {}

  // False if it was interrupted. Throws RunFailure where an increment fails.
  bool run();

 private:
  bool press(const ActionSpec& action, double sign);
  bool press_to_force(const ActionSpec& action);
  bool scan(const ActionSpec& action);
  bool raster(const ActionSpec& action);
  bool traverse(const std::array<double, 3>& travel, int increments, bool servo);
  bool cross(const std::array<double, 3>& travel, const ActionSpec& action);  // a line of a raster
  // An increment; refuses a probe that has locked.
  void pass(const std::array<double, 3>& step, bool servo);
  // Moves the target; splits the step in half where no equilibrium is found, or where an adhesive tip is released
  // somewhere within it.
  void advance(const std::array<double, 3>& travel, bool servo, int depth);
  bool is_released_too_far(const std::array<double, 3>& travel, bool servo) const;
  // Equilibrium for the target where it is, starting from the extrapolation of the last increments.
  NewtonReport equilibrium(const NewtonSettings& settings, const IncrementStep& step);
  // Stops the run at self-locking: friction grows with the force, so nothing overcomes it.
  void refuse_lock(const std::array<double, 3>& travel) const;
  bool tell();
  bool skip();  // the increment was already made
  void hold_force(std::size_t action);
  double vertical_force() const;
  bool adheres() const;
  bool touches() const;  // now
  bool touched() const;  // at the last equilibrium

  const Scene& scene_;
  AfmModel& model_;
  StaticSolver& solver_;
  AfmPosition& position_;
  Record record_;
  std::int64_t to_skip_ = 0;     // increments
  double time_ = 0, share_ = 1;  // of the current increment, in actions
  int iterations_ = 0;           // of the last increment, including its cuts
  double lowest_ = std::numeric_limits<double>::infinity();  // N, vertical force since the last row
  const char* doing_ = "";
};

}  // namespace pulvis
