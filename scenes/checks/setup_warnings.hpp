// What a scene of particles may have wrong though each of its values is allowed.
//
// Speed  a tool that enters the powder at v presses it with about rho v^2/2 by its inertia alone. Pressing is
//        quasi-static where that is a small share of what the particles bear: of their yield stress, or, where
//        they are elastic, of E at a strain of a hundredth.
#pragma once

#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct FastTool {
  int stage = 0, tool = 0;
  double speed = 0;   // m/s, the highest of the stage
  double energy = 0;  // Pa, rho v^2/2 of the heaviest particles
  double share = 0;   // -, of what the softest bear
};
// The same of a move at this speed, in a powder of these materials.
FastTool fast_tool(const Scene& scene, int stage, int tool, double speed);
// One line where it is no longer quasi-static; otherwise empty.
std::string too_fast(const Scene& scene, const FastTool& fast, const std::string& tool);

// The fastest prescribed move towards the powder; of speed 0 where there is none.
FastTool fastest_tool(const Scene& scene);

// One line each. The packings are filled.
std::vector<std::string> setup_warnings(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
