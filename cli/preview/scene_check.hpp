// pulvis check: whether a scene is valid, and what a user should know about it before it runs.
#pragma once

#include <string>
#include <vector>

#include "cli/exit_code.hpp"
#include "scenes/lever/afm_build.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/simulation.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// What is reported about a scene, in the order of its lines.
struct SceneFindings {
  std::string sizes;                  // of packings and meshes: complete lines
  std::vector<std::string> warnings;  // one line each
  std::string memory, stages, run;    // one line each, or empty
  std::string time_step;              // two lines, or empty
  std::string verdict;                // one line
};
// Advances the simulation. `simulation`: at its start; null if memory is too small.
SceneFindings findings_of(const Scene& scene, const std::vector<BodySpec>& bodies,
                          const MemoryNeed& need, Simulation* simulation);
SceneFindings findings_of(const Scene& scene, const AfmModel& model);
void tell_findings(const SceneFindings& findings);

// For an AFM scene, before its memory is allocated. Throws OutputError if there is not enough.
void tell_lever_memory(const Scene& scene);

ExitCode check_scene(const Scene& scene);

}  // namespace pulvis
