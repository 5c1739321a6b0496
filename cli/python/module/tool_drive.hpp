// Tools driven from outside instead of by their stages: from the current step on at a given velocity or, if a servo
// moves them, with a given force.
#pragma once

#include <string>
#include <vector>

#include "components/shape.hpp"
#include "scenes/simulation.hpp"

namespace pulvis::python {

std::vector<std::string> tool_names(Simulation& simulation);
// Between two steps. Replaces the tool's prescribed motion from t_n on; its position and velocity up to then stay.
// Throws NotNow for a tool with a servo or compliant drive, and OutOfRange for a velocity that no
// particle of a scene may have, or that is too high for contact detection.
void drive_tool(Simulation& simulation, const Scene& scene, const std::string& name,
                const Point3& velocity);

// Tools with a force servo in at least one stage.
std::vector<std::string> servo_names(Simulation& simulation);
struct ServoView {
  double target = 0;   // N, 0 in stages without it: series force_asked
  Point3 direction{};  // pushing direction: of the current stage, else of its first one
  bool holds = false;  // in the current stage
};
ServoView servo_view(Simulation& simulation, const std::string& name);
// Between two steps: from the end of the next step on, the target force is `force`, in N, in every stage that has the
// servo, without a ramp. Throws NotNow for a tool without a servo, and OutOfRange for a force that a scene may not ask
// for.
void drive_servo(Simulation& simulation, const Scene& scene, const std::string& name, double force);

}  // namespace pulvis::python
