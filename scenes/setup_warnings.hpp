// Likely mistakes in a scene of particles whose values are all allowed.
//
// Speed  a tool that enters the powder at v exerts a pressure of about rho v^2/2 by inertia alone. Pressing is
//        quasi-static where that is a small fraction of what the particles bear: their yield stress or, where
//        they are elastic, E at a strain of 1 %.
#pragma once

#include <string>
#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct FastTool {
  int stage = 0, tool = 0;
  double speed = 0;   // m/s, highest in the stage
  double energy = 0;  // Pa, rho v^2/2 of the densest particles
  double share = 0;   // -, fraction of what the softest bear
};
// The same for a move at this speed, in a powder of these materials.
FastTool fast_tool(const Scene& scene, int stage, int tool, double speed);
// One line if it is no longer quasi-static; otherwise empty.
std::string too_fast(const Scene& scene, const FastTool& fast, const std::string& tool);

// The fastest prescribed move towards the powder; its speed is 0 if there is none.
FastTool fastest_tool(const Scene& scene);

// One line for each warning. The packings must be filled.
std::vector<std::string> setup_warnings(const Scene& scene, const std::vector<BodySpec>& bodies);

// Everything that can be told before the first step: those, and warnings of bonds and servos, which need the world in its
// initial state. `world`: null if there is not enough memory for it.
std::vector<std::string> all_warnings(const Scene& scene, const std::vector<BodySpec>& bodies,
                                      const World* world);

}  // namespace pulvis
