// What a shear stage is about: a target surface drawn along under the powder, the friction that it meets, and
// how the compact answers.
#pragma once

#include <optional>
#include <vector>

#include "components/run_state.hpp"
#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// The first stage of kind "shear" in which a tool moves along its own face: the one that moves farthest so is the target.
struct ShearSetup {
  int stage = 0, target = 0;
  int punch = -1;              // the plane on the other side of the powder; -1: none
  int wall = -1;               // the plane that the target draws the powder against; -1: none
  Vec2 along = Vec2::UnitX();  // the direction in which the target moves
  Vec2 up = Vec2::UnitY();     // out of the target
  double width = 0;            // m, between the walls; 0: there are no two
};
std::optional<ShearSetup> shear_setup(const Scene& scene);

// Static and dynamic friction of the shear stage, which later ones do not change, and how much went into them. None where
// the target bore nothing there, where there is no width, or no punch.
struct ShearFigures {
  double distance = 0;                      // m
  std::optional<double> static_friction;    // largest in the first quarter of the distance
  std::optional<double> dynamic_friction;   // mean over the second half of the distance
  std::optional<double> dynamic_deviation;  // its standard deviation there
  std::optional<double> normal_stress;      // Pa, mean over the second half
  std::optional<double> dilation;           // m, at the end of the stage
};

class ShearResults {
 public:
  // `world` has the tools of the scene.
  ShearResults(const Scene& scene, const World& world);

  static std::vector<SeriesInfo> series(const Scene& scene);
  static std::vector<FieldInfo> fields(const Scene& scene);

  // In the order of series(); of an observed world and what it has spent in plastic flow [J]. Sums up slip over
  // samples.
  void append_sample(double plastic, std::vector<double>& row);
  void append_frame(std::vector<std::vector<double>>& fields) const;
  // None before the target has moved.
  std::optional<ShearFigures> figures() const;

  // What a checkpoint keeps; the rest is the scene's.
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
  int take_touching(bool sliding);  // sums up slip while sliding; returns how many go along

  std::optional<ShearSetup> setup_;
  const World& world_;
  std::optional<double> punch_at_begin_;  // m, along `up`
  double punch_before_ = 0;
  double time_before_ = 0, work_ = 0, lateral_before_ = 0, distance_before_ = 0;
  std::vector<double> slip_;                // m, [particles]
  std::vector<Sample> samples_;             // of the shear stage, as long as the target goes on
  double plastic_at_begin_ = 0;             // J
  double travel_at_begin_ = 0;              // m
  double pressed_ = 0, normal_before_ = 0;  // N m, the normal force over the distance; N
};

}  // namespace pulvis
