// pulvis check: whether a scene is right, and what a user should know of it before it runs.
#pragma once

#include <string>
#include <vector>

#include "cli/exit_code.hpp"
#include "scenes/simulation.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Of everything that can be said before the first step. `simulation`: at its start; none where memory is too small.
std::vector<std::string> warnings_of(const Scene& scene, const std::vector<BodySpec>& bodies,
                                     Simulation* simulation);

ExitCode check_particle_scene(const Scene& scene);

}  // namespace pulvis
