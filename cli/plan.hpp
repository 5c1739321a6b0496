// pulvis plan: what a scene would run, without running it: systems in order, edges, columns and bytes.
#pragma once

#include <string>

#include "engine/task_graph.hpp"
#include "engine/world.hpp"

namespace pulvis {

std::string plan_text(const GraphPlan& plan, const World& world);
std::string plan_dot(const GraphPlan& plan);  // Graphviz

}  // namespace pulvis
