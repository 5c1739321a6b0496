// Converts an AFM's volts to friction: one function of all inputs, each with its standard uncertainty.
//
// Source   normal force F_n = k_n V/S (S: slope of force curves on a hard surface, V/m of the piezo);
//          lateral force from loops on slopes (scenes/wedge/wedge_calibration.hpp), or a test probe (Cannara,
//          Eglin & Carpick 2006): a side contact at the arm h_t twists the test lever by q_t y/h_t, so a radian
//          gives S_t h_t/q_t volts, times the light intensity ratio r; the lever twists by F q h/(k_l h^2), so
//            F/V = k_l h q_t/(q r S_t h_t)
//          with q the shares of twist in the lateral displacements
//          crosstalk c: lateral volts minus c times the normal ones
//          Where slopes disagree by more than their uncertainty, the Birge ratio (1932) for the error of their
//          mean is a separate input
//          sample: friction F = mu (L + A): mu is the slope over the loads, A follows from where the line is
//          zero; or, for each loop, mu = F/(L + A) with A from the pull-off
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/laboratory/volts/lever_input.hpp"
#include "cli/laboratory/volts/volts_records.hpp"
#include "scenes/wedge/wedge_calibration.hpp"

namespace pulvis::volts {

struct Input {
  std::string name;
  std::string unit;
  int group = 0;  // index into Model::groups: inputs sampled and reported together
  double value = 0, error = 0;
};

struct WedgeKnown {  // from the settings of the wedge
  double adhesion = 0, slope_error = 0, load_error = 0;
  std::optional<double> expected_friction = {};
};

struct Measured {
  Lever lever;
  Sensitivity hard, sample;       // force curves
  std::optional<lab::Mean> side;  // V/m, slope of the test probe's side contacts
  std::optional<lab::Mean> crosstalk;
  LoopRecord loops;
  std::optional<LoopRecord> wedge;
  WedgeKnown known;
};

// Results, by position.
struct Outcome {
  double normal = 0, lateral = 0;          // N/V
  double adhesion = 0;                     // N, pull-off
  double friction = 0;                     // slope over the loads, or mean of the loops at one load
  std::optional<double> adhesion_of_line;  // N
  double friction_of_loops = 0;            // mean of F/(L + A)
  std::vector<double> friction_of_loop;
  std::vector<double> load, force;  // N, of the loops
};

class Model {
 public:
  // Throws SceneError where the loops do not say how uncertain they are. `takes_other_root`: of the two friction
  // coefficients that loops on slopes fit, the one not chosen (scenes/wedge/wedge_calibration.hpp).
  Model(const Measured& measured, const VoltsSpec& spec, bool takes_other_root = false);

  const std::vector<Input>& inputs() const { return inputs_; }
  const std::vector<std::string>& groups() const { return groups_; }
  std::vector<double> values() const;  // of all inputs
  // The loops on slopes, at the values of the inputs.
  const std::optional<wedge::Calibration>& slopes() const { return slopes_; }

  // Throws std::runtime_error where no friction fits the loops on slopes.
  Outcome evaluate(const std::vector<double>& x) const;

 private:
  struct LoopInputs {
    std::vector<std::size_t> width, offset;
  };
  std::size_t add(const std::string& group, const std::string& name, const char* unit,
                  const lab::Mean& value);
  LoopInputs add_loops(const std::string& group, const LoopRecord& record, bool offsets);
  void add_wedge(bool takes_other_root);
  void add_test_probe(const VoltsSpec& spec);
  std::vector<wedge::Loop> loops_on_slopes(const std::vector<double>& x, double normal,
                                           double crosstalk) const;
  wedge::Calibration on_slopes(const std::vector<wedge::Loop>& loops) const;
  double weighted(const wedge::Calibration& calibration) const;
  void weigh_slopes(bool takes_other_root);
  double lateral_by_wedge(const std::vector<double>& x, double normal, double crosstalk) const;
  double lateral_by_probe(const std::vector<double>& x) const;
  double normal_volts(const LoopRecord& record, const VoltsLoop& loop, double normal) const;

  Measured measured_;
  LateralMethod lateral_;
  std::vector<Input> inputs_;
  std::vector<std::string> groups_;
  std::map<std::string, std::size_t> at_;  // of single inputs, by name
  LoopInputs sample_, wedge_;
  std::map<double, std::size_t> slope_at_;
  std::optional<wedge::Calibration> slopes_;
  wedge::Root root_ = wedge::Root::lower;  // the same in every draw, like the weights
  std::vector<double> weights_;            // of the slopes
  bool disagree_ = false;
};

}  // namespace pulvis::volts
