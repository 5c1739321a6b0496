// Tools driven from outside, instead of what their stages say: from the present step on with a set velocity, or, where a
// servo moves them, with a set force.
#pragma once

#include <string>
#include <vector>

#include "components/shape.hpp"
#include "scenes/simulation.hpp"

namespace pulvis::python {

std::vector<std::string> tool_names(Simulation& simulation);
// Between two steps. The tool's programme of motion is replaced from t_n on; where it stood, and how fast it came there,
// stays. Throws NotNow for a tool that holds a force or gives, and for a velocity beyond what a step can see.
void drive_tool(Simulation& simulation, const std::string& name, const Point3& velocity);

// Tools that hold a force in some stage.
std::vector<std::string> servo_names(Simulation& simulation);
struct ServoView {
  double asked = 0;    // N, 0 in stages without it: series force_asked
  Point3 direction{};  // in which it pushes: of the present stage, else of its first one
  bool holds = false;  // in the present stage
};
ServoView servo_view(Simulation& simulation, const std::string& name);
// Between two steps: from the end of the next step on the servo asks for `force`, in N, in every stage that has it, without
// a ramp. Throws NotNow for a tool without servo, and for a force that none can push with.
void drive_servo(Simulation& simulation, const std::string& name, double force);

}  // namespace pulvis::python
