// Force-controlled tools, and stages that end on a condition: only in scenes that use them.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "components/die_room.hpp"
#include "components/relief.hpp"
#include "components/run_state.hpp"
#include "components/shape.hpp"

namespace pulvis {

// ---- servos ---------------------------------------------------------------------------------------
struct ServoTravel : Component<Tool, double, tool_axes> {
  static constexpr ComponentInfo info{"servo_travel", "m", "displacement by servos so far"};
};
struct ServoVelocity : Component<Tool, double, tool_axes> {
  static constexpr ComponentInfo info{"servo_velocity", "m/s", "of its servo, over the next step"};
};
struct ServoMass : Component<Tool, double, 1> {
  static constexpr ComponentInfo info{"servo_mass", "kg", "with which its servo lets it move"};
};
struct ServoDragged : Component<Tool, double, tool_axes> {
  static constexpr ComponentInfo info{"servo_dragged", "m/s",
                                      "velocity of the mass that it drags along through a dashpot"};
};
struct ServoForce : Component<Tool, double, 2> {
  static constexpr ComponentInfo info{
      "servo_force", "N",
      "asked for now, or of a drive that gives on its tool, and what "
      "the tool bore when its stage began"};
};

// How a powder has answered its servo of late: force and travel relative to themselves a lag ago, and the slope of the one
// over the other by least squares (systems/tools/servo_kernel.hpp).
struct ServoResponse {
  double force = 0;    // N, what it was
  double travel = 0;   // m, since then
  double product = 0;  // N m, mean of rise in force times travel
  double square = 0;   // m^2, mean of travel squared

  double stiffness() const { return product > 0 ? product / square : 0; }  // N/m

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(force, travel, product, square);
  }
};

// How well a servo has kept to its target. N; for a cell Pa.
struct ServoWatch {
  double overshoot = 0;  // -, largest excess over the larger of the forces
                         // at the start and the end of a stage
  double lowest = std::numeric_limits<double>::infinity();  // error in the last part of the stage
  double highest = -std::numeric_limits<double>::infinity();

  void see_force(double force, double largest) {
    if (largest > 0) overshoot = std::max(overshoot, force / largest - 1);
  }
  void see_error(double error) {
    lowest = std::min(lowest, error);
    highest = std::max(highest, error);
  }
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(overshoot, lowest, highest);
  }
};
// Whether the force of a stage is judged at this time: over the last tenth of its duration.
inline bool is_judged(const ToolProgram::Stage& stage, double time) {
  return time >= stage.end - 0.1 * (stage.end - stage.begin);
}

// What drives a tool during a stage: the prescribed force, a servo mass, and a second mass coupled to it
// through a dashpot (systems/tools/servo_kernel.hpp).
struct ToolServos {
  static constexpr const char* resource_name = "tool_servos";
  struct Servo {
    int tool = 0;
    int stage = 0;
    Point3 direction{};       // unit vector: pushing direction
    double force = 0;         // N, target
    double rise = 0;          // s, time to ramp up to the full force
    double rate = 0;          // N/s, used instead of `rise`; 0: none
    double mass = 0;          // kg, minimum mass of the tool
    double damping = 0;       // N s/m, of its dashpot at that mass; scales with its square root
    double max_speed = 0;     // m/s
    double tolerance = 0.05;  // -, of the force, over the last part of the stage
    double wave = 0;          // N s/m, force of a wave into a solid block of the powder, over speed
    double powder_mass = 0;   // kg
    // A compliant drive instead of a constant force: 0, or N/m; `damping` is then that of its dashpot.
    double stiffness = 0;
    bool holds_force() const { return stiffness == 0; }
  };
  // Set externally: takes effect at once, and overrides the servos of this tool in all stages.
  struct Driven {
    int tool = 0;
    double force = 0;  // N
    template <class Bytes>
    void state(Bytes& bytes) {
      bytes(tool, force);
    }
  };
  std::vector<Servo> servos;
  std::vector<Driven> driven;
  std::vector<ServoResponse> responses;              // [tools]
  std::vector<ServoWatch> watches;                   // [servos]
  std::size_t stage = static_cast<std::size_t>(-1);  // stage of the last step

  const Driven* driven_force(int of_tool) const {
    for (const Driven& one : driven)
      if (one.tool == of_tool) return &one;
    return nullptr;
  }

  void make_room(std::size_t tools) {
    responses.resize(tools);
    watches.resize(servos.size());
  }

  // The servos come from the scene.
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(stage, driven, responses, watches);
  }
};

// ---- stages that end on a condition ---------------------------------------------------------------
struct StageEnds {
  static constexpr const char* resource_name = "stage_ends";
  enum class Kind { force, displacement, density };
  struct End {
    int stage = 0;
    Kind kind = Kind::force;
    int tool = 0;        // whose force or displacement is monitored
    Point3 direction{};  // of the force component; zero: magnitude of the resultant
    double value = 0;    // N, m or -
    bool reached = false;

    // All other members come from the scene.
    template <class Bytes>
    void state(Bytes& bytes) {
      bytes(reached);
    }
  };
  struct Cell {  // tools around the powder, for relative density
    int left = 0, right = 0, bottom = 0, top = 0;
    Relief relief = {};  // of the bottom tool
  };
  std::vector<End> ends;
  double content = 0;  // m^2 or m^3, undeformed, of all particles
  Cell cell;
  std::optional<DieRoom> room = {};    // used instead of the cell in three dimensions
  std::vector<Point3> tools_at_begin;  // m, [tools]: tool positions at the start of the stage
  double run_end = std::numeric_limits<double>::infinity();  // s: Clock::end from the next step on
  std::size_t stage = static_cast<std::size_t>(-1);

  bool has_ended_early(std::size_t of_stage) const {
    return std::ranges::any_of(ends, [&](const End& end) {
      return end.reached && static_cast<std::size_t>(end.stage) == of_stage;
    });
  }

  // Cell and room come from the scene.
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(ends, tools_at_begin, stage, run_end);
  }
};

}  // namespace pulvis
