#include "cli/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pulvis {
namespace {

std::string accesses_text(const StagePlan& stage, AccessMode mode) {
  std::string text;
  for (const AccessInfo& access : stage.accesses)
    if (access.mode == mode) text += (text.empty() ? "" : ", ") + access.name;
  return text;
}

std::string stage_name(const StagePlan& stage) {
  std::string name;
  for (const std::string& system : stage.systems) name += (name.empty() ? "" : " > ") + system;
  return name;
}

}  // namespace

std::string plan_text(const GraphPlan& plan, const std::vector<std::string>& sampled,
                      const World& world) {
  std::string out = "systems of a step, in order; systems on one line are fused chunk by chunk\n";
  for (std::size_t s = 0; s < plan.stages.size(); ++s) {
    const StagePlan& stage = plan.stages[s];
    out += fmt::format("{:3}  {} {}\n", s, stage.by_chunk ? "chunk" : "world", stage_name(stage));
    for (const auto& [label, mode] : {std::pair{"reads", AccessMode::read},
                                      {"writes", AccessMode::write},
                                      {"resizes", AccessMode::structural}})
      if (const std::string list = accesses_text(stage, mode); !list.empty())
        out += fmt::format("       {} {}\n", label, list);
  }
  out += "\nedges\n";
  for (const auto& [earlier, later] : plan.edges)
    out += fmt::format("  {} -> {}\n", earlier, later);

  if (!sampled.empty())
    out += fmt::format("\nsystems that only sampled steps run, after the forces\n     {}\n",
                       fmt::join(sampled, ", "));

  out += "\ncolumns\n";
  std::size_t total = 0;
  for (const ColumnBase* column : world.columns()) {
    out += fmt::format("  {:<13} {:<20} {:>3} x {:<7} {:>12} B  {}\n", column->entity,
                       column->info.name, column->count, column->info.unit, column->bytes(),
                       column->info.meaning);
    total += column->bytes();
  }
  return out +
         fmt::format("  {:>60} B in total (the number of contact rows varies with the contacts)\n",
                     total);
}

std::string plan_dot(const GraphPlan& plan) {
  std::string out = "digraph step {\n  rankdir=TB; node [shape=box, fontname=\"sans-serif\"];\n";
  for (std::size_t s = 0; s < plan.stages.size(); ++s) {
    std::string label;
    for (const std::string& system : plan.stages[s].systems) label += system + "\\n";
    out += fmt::format("  s{} [label=\"{}\"{}];\n", s, label,
                       plan.stages[s].by_chunk ? ", style=filled, fillcolor=lightgrey" : "");
  }
  for (const auto& [earlier, later] : plan.edges)
    out += fmt::format("  s{} -> s{};\n", earlier, later);
  return out + "}\n";
}

}  // namespace pulvis
