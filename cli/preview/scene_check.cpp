#include "cli/preview/scene_check.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <optional>

#include "cli/preview/estimate.hpp"
#include "cli/preview/stage_forecast.hpp"
#include "cli/setup_progress.hpp"
#include "cli/step_limits.hpp"
#include "cli/tell.hpp"
#include "engine/machine_memory.hpp"
#include "engine/run_failure.hpp"
#include "scenes/checks/lever_warnings.hpp"
#include "scenes/checks/overlaps.hpp"
#include "scenes/checks/scene_summary.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/language/units.hpp"
#include "scenes/lever/afm_size.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/setup_warnings.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

// A run that fails in its first steps has no estimate; `run` reports why.
std::string estimate_line(Simulation* simulation, const Scene& scene, std::size_t count,
                          const std::vector<StageForecast>& stages) {
  if (simulation == nullptr) return "warning: this machine does not have enough memory for the run";
  try {
    return estimate_text(estimate_run(*simulation, scene, count, stages));
  } catch (const RunFailure& failure) {
    return fmt::format("warning: the run fails in its first steps: {}", failure.what());
  }
}

// What sets the first step, and what the slowest elements cost. A run that fails in it has no such lines.
std::string time_step_lines(Simulation& simulation, const Scene& scene) {
  try {
    simulation.observe();
    const TimeStepLimit limit = time_step_limit(simulation.world());
    simulation.move();
    return fmt::format("time step: {}\nelements: {}",
                       time_step_text(limit, scene.time.safety, scene.in_space() ? 3 : 2),
                       slowest_elements_text(limit));
  } catch (const RunFailure&) {
    return {};
  }
}

std::string memory_line(const MemoryNeed& need) {
  return fmt::format("memory: about {}: particles {}, contacts {}, results {}, program {}",
                     bytes_text(need.total()), bytes_text(need.columns), bytes_text(need.contacts),
                     bytes_text(need.results), bytes_text(need.program));
}

}  // namespace

SceneFindings findings_of(const Scene& scene, const std::vector<BodySpec>& bodies,
                          const MemoryNeed& need, Simulation* simulation) {
  SceneFindings findings;
  findings.sizes = packing_summary(scene) + mesh_summary(scene);
  findings.warnings =
      all_warnings(scene, bodies, simulation == nullptr ? nullptr : &simulation->world());
  findings.memory = memory_line(need);
  const std::vector<StageForecast> stages = stage_forecast(scene, bodies);
  findings.stages = stages_text(scene, stages);
  if (simulation != nullptr) findings.time_step = time_step_lines(*simulation, scene);
  findings.run = estimate_line(simulation, scene, bodies.size(), stages);
  findings.verdict =
      fmt::format("{}: good: {}, {}, {}", scene.file.string(), counted(bodies.size(), "particle"),
                  counted(scene.tools.size(), "tool"), counted(scene.stages.size(), "stage"));
  return findings;
}

namespace {

SceneFindings findings_of_powder(const Scene& scene) {
  const SetupProgress progress;
  const std::vector<BodySpec> bodies = place_bodies(scene);
  check_overlaps(scene, bodies);
  const MemoryNeed need = memory_need(scene);
  std::optional<Simulation> simulation;
  if (need.total() <= available_memory()) simulation.emplace(scene);
  return findings_of(scene, bodies, need, simulation ? &*simulation : nullptr);
}

SceneFindings findings_of_lever(const Scene& scene) {
  const SetupProgress progress;
  return findings_of(scene, build_afm(scene));
}

}  // namespace

SceneFindings findings_of(const Scene& scene, const AfmModel& model) {
  std::size_t increments = 0;
  for (const ActionSpec& action : scene.afm->actions) increments += action.samples();
  SceneFindings findings;
  findings.warnings = lever_warnings(scene);
  if (increments > 0)
    findings.run = fmt::format(
        "run: at least {}, each as long as one to three factorisations of the stiffness matrix",
        counted(increments, "increment"));
  findings.verdict = fmt::format("{}: good: {}, {}", scene.file.string(),
                                 counted(model.elements, "element"), counted(model.nodes, "node"));
  return findings;
}

void tell_findings(const SceneFindings& findings) {
  tell("{}", findings.sizes);
  for (const std::string& line : findings.warnings) tell("warning: {}\n", line);
  for (const std::string& line :
       {findings.memory, findings.stages, findings.time_step, findings.run, findings.verdict})
    if (!line.empty()) tell("{}\n", line);
}

void tell_lever_memory(const Scene& scene) {
  tell("memory: about {}\n", bytes_text(static_cast<std::uint64_t>(afm_size(*scene.afm).bytes())));
  flush(stdout);
  require_afm_memory(scene);
}

ExitCode check_scene(const Scene& scene) {
  if (scene.afm) tell_lever_memory(scene);
  tell_findings(scene.afm ? findings_of_lever(scene) : findings_of_powder(scene));
  return ExitCode::done;
}

}  // namespace pulvis
