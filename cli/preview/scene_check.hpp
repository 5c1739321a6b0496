// pulvis check: whether a scene is right, and what a user should know of it before it runs.
#pragma once

#include <string>
#include <vector>

#include "cli/exit_code.hpp"
#include "scenes/lever/afm_build.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/simulation.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis {

// Of everything that can be said before the first step. `simulation`: at its start; none where memory is too small.
std::vector<std::string> warnings_of(const Scene& scene, const std::vector<BodySpec>& bodies,
                                     Simulation* simulation);

// What is told of a scene, in the order of its lines.
struct SceneFindings {
  std::string sizes;                  // of packings and meshes: whole lines
  std::vector<std::string> warnings;  // one line each
  std::string memory, run;            // a line each, or empty
  std::string verdict;                // a line
};
// Moves the simulation on.
SceneFindings findings_of(const Scene& scene, const std::vector<BodySpec>& bodies,
                          const MemoryNeed& need, Simulation* simulation);
SceneFindings findings_of(const Scene& scene, const std::vector<space::BodySpec>& bodies,
                          const MemoryNeed& need, Simulation* simulation);
SceneFindings findings_of(const Scene& scene, const AfmModel& model);
void tell_findings(const SceneFindings& findings);

// Of an AFM scene, before it is taken. Throws OutputError where there is not so much.
void tell_lever_memory(const Scene& scene);

ExitCode check_scene(const Scene& scene);

}  // namespace pulvis
