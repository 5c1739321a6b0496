// Whether prescribed moves leave room for the volume of the particles.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

double powder_volume(const Scene& scene, const std::vector<BodySpec>& bodies);
// -, between six planes or in a round die before the first step; none if nothing encloses the powder.
std::optional<double> density_at_start(const Scene& scene, const std::vector<BodySpec>& bodies);

struct FullDensity {  // if moves alone take the tools beyond it
  int stage = 0, tool = 0;
  double travel = 0;      // m, of that tool in the stage
  double until_full = 0;  // m, of that tool until the room equals the particle volume
  double density = 0;     // -, at the end of the stage; infinite if no room is left
};
std::optional<FullDensity> full_density(const Scene& scene, const std::vector<BodySpec>& bodies);

// If a stage of kind "compact" moves tools away from the powder only.
std::vector<std::string> leaving_warnings(const Scene& scene);

// Throws SceneError if a move goes far beyond full density, or leaves no room between two faces.
void check_travel(const Scene& scene, const std::vector<BodySpec>& bodies);
// One line if it goes slightly beyond.
std::vector<std::string> travel_warnings(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
