#include "cli/preview/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "cli/pack.hpp"
#include "cli/preview/estimate.hpp"
#include "cli/tell.hpp"
#include "engine/machine_memory.hpp"
#include "engine/run_failure.hpp"
#include "scenes/checks/bending_error.hpp"
#include "scenes/checks/bond_checks.hpp"
#include "scenes/checks/mesh_summary.hpp"
#include "scenes/checks/overlaps.hpp"
#include "scenes/checks/setup_warnings.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/language/units.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/tools/bond_rules.hpp"

namespace pulvis {
namespace {

// A run that fails in its first steps has no estimate; `run` says why.
std::string estimate_line(Simulation* simulation) {
  if (simulation == nullptr) return "warning: this machine has not enough memory for the run";
  try {
    return estimate_text(estimate_run(*simulation));
  } catch (const RunFailure& failure) {
    return fmt::format("warning: the run fails in its first steps: {}", failure.what());
  }
}

}  // namespace

std::vector<std::string> warnings_of(const Scene& scene, const std::vector<BodySpec>& bodies,
                                     Simulation* simulation) {
  std::vector<std::string> lines = bending_warnings(scene);
  if (simulation != nullptr &&
      has_bonds(scene))  // what is bonded is known once contacts have been looked for
    std::ranges::move(bond_warnings(scene, simulation->world()), std::back_inserter(lines));
  std::ranges::move(setup_warnings(scene, bodies), std::back_inserter(lines));
  return lines;
}

ExitCode check_particle_scene(const Scene& scene) {
  const std::vector<BodySpec> bodies = place_bodies(scene);
  const MemoryNeed need = memory_need(scene);
  check_overlaps(scene, bodies);
  std::optional<Simulation> simulation;
  if (need.total() <= available_memory()) simulation.emplace(scene);
  Simulation* const first = simulation ? &*simulation : nullptr;
  tell("{}", packing_summary(scene));
  tell("{}", mesh_summary(scene));
  for (const std::string& line : warnings_of(scene, bodies, first)) tell("warning: {}\n", line);
  tell("memory: about {}: particles {}, contacts {}, results {}, program {}\n",
       bytes_text(need.total()), bytes_text(need.columns), bytes_text(need.contacts),
       bytes_text(need.results), bytes_text(need.program));
  tell("{}\n", estimate_line(first));
  tell("{}: good: {}, {}, {}\n", scene.file.string(), counted(bodies.size(), "particle"),
       counted(scene.tools.size(), "tool"), counted(scene.stages.size(), "stage"));
  return ExitCode::done;
}

}  // namespace pulvis
