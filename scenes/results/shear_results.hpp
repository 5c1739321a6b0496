// Results of a shear stage: a target surface dragged along under the powder, the friction on it, and
// the response of the compact.
#pragma once

#include <optional>
#include <vector>

#include "components/run_state.hpp"
#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// The first stage of kind "shear" in which a tool moves along its own face: the tool that moves farthest is the target.
struct ShearSetup {
  int stage = 0, target = 0;
  int punch = -1;              // the plane on the other side of the powder; -1: none
  int wall = -1;               // the plane against which the target drags the powder; -1: none
  Vec2 along = Vec2::UnitX();  // the direction in which the target moves
  Vec2 up = Vec2::UnitY();     // outward normal of the target
  double width = 0;            // m, between the walls; 0: there are no two walls
  double planned = 0;          // m, by which the target is to move in that stage
};
std::optional<ShearSetup> shear_setup(const Scene& scene);

// Static and dynamic friction of the shear stage, unaffected by later ones, and the data behind them. Empty where
// the target carried no load there, or where there is no width or no punch.
struct ShearFigures {
  double distance = 0;                      // m
  std::optional<double> static_friction;    // largest in the first quarter of the distance
  std::optional<double> dynamic_friction;   // mean over the second half of the distance
  std::optional<double> dynamic_deviation;  // its standard deviation there
  std::optional<double> normal_stress;      // Pa, mean over the second half
  std::optional<double> dilation;           // m, at the end of the stage
};

// At a sample; series of the history. NaN where there is no such value.
struct ShearSample {
  double distance = 0, friction = 0;              // m, -
  double work = 0, plastic_work = 0;              // J
  double ploughing = 0;                           // -
  int locked = 0;                                 // particles
  double normal_stress = 0, lateral_stress = 0;   // Pa, on the target
  double punch_lateral_stress = 0, dilation = 0;  // Pa, m
  double wall_share = 0;                          // -
};

class ShearResults {
 public:
  // `world` has the tools of the scene.
  ShearResults(const Scene& scene, const World& world);

  // Of an observed world and its plastic dissipation [J]. Accumulates work and slip over samples.
  void sample(double plastic);
  const ShearSample& now() const { return now_; }
  // m, of every particle past the target.
  const std::vector<double>& slip() const { return slip_; }
  // Empty before the target has moved.
  std::optional<ShearFigures> figures() const;

  // Stored in a checkpoint; the rest comes from the scene.
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(punch_at_begin_, punch_before_, time_before_, work_, lateral_before_, distance_before_,
          slip_, samples_, plastic_at_begin_, travel_at_begin_, pressed_, normal_before_);
  }

 private:
  struct Sample {
    double distance, friction, normal_stress, dilation;
    template <class Bytes>
    void state(Bytes& bytes) {
      bytes(distance, friction, normal_stress, dilation);
    }
  };
  const ToolProgram::Stage& stage() const;
  double travel_now() const;
  double distance_now() const;
  int take_touching(bool sliding);  // accumulates slip while sliding; returns the number locked
  void take_work(double lateral, double normal, double plastic);
  void take_dilation();
  void keep_of_stage(double lateral, double normal);

  std::optional<ShearSetup> setup_;
  const World& world_;
  ShearSample now_;
  std::optional<double> punch_at_begin_;  // m, along `up`
  double punch_before_ = 0;
  double time_before_ = 0, work_ = 0, lateral_before_ = 0, distance_before_ = 0;
  std::vector<double> slip_;                // m, [particles]
  std::vector<Sample> samples_;             // of the shear stage, while the target moves
  double plastic_at_begin_ = 0;             // J
  double travel_at_begin_ = 0;              // m
  double pressed_ = 0, normal_before_ = 0;  // N m, normal force integrated over the distance; N
};

}  // namespace pulvis
