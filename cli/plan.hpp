// pulvis plan: what a scene would run, without running it: systems in order, edges, columns and bytes.
#pragma once

#include <string>
#include <vector>

#include "engine/task_graph.hpp"
#include "engine/world.hpp"

namespace pulvis {

// `sampled`: names of the systems that only sampled steps run.
std::string plan_text(const GraphPlan& plan, const std::vector<std::string>& sampled,
                      const World& world);
std::string plan_dot(const GraphPlan& plan);  // Graphviz

}  // namespace pulvis
