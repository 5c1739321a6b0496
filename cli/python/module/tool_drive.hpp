// Tools driven from outside: from the present step on with a set velocity, instead of what their stages say.
#pragma once

#include <string>
#include <vector>

#include "components/shape.hpp"
#include "scenes/simulation.hpp"

namespace pulvis::python {

std::vector<std::string> tool_names(Simulation& simulation);
// Between two steps. The tool's programme of motion is replaced from t_n on; where it stood, and how fast it came there,
// stays. Throws NotNow for a tool that holds a force or gives, and for a velocity beyond what a step can see.
void drive_tool(Simulation& simulation, const std::string& name, const Point& velocity);

}  // namespace pulvis::python
