// How far the walls of a die travel, compared with the room that the solid itself takes up.
//
// A die of four planes encloses a known area at every instant, one of six planes or a round one a volume. Where it falls
// below that of the particles, the relative density exceeds 1: no pores are left, and only the solid's elastic compression
// can yield room.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// The first stage in which prescribed moves alone bring the die to full density.
struct FullDensity {
  int stage = 0;
  int tool = 0;           // the one that travels farthest into the die
  double travel = 0;      // m, of that tool over the stage
  double until_full = 0;  // m, of that tool until the relative density is 1
  double density = 0;     // -, at the end of the stage; infinite if the die has no room left
  double volume_strain() const { return 1 - 1 / density; }  // elastic, of the solid
};

// None if there is no such die, or if forces, compliant drives, an `until` or an initial state
// decide how far a tool gets before full density.
std::optional<FullDensity> full_density(const Scene& scene, const std::vector<BodySpec>& bodies);

// -, of such a die at its start; none for other scenes.
std::optional<double> density_at_start(const Scene& scene, const std::vector<BodySpec>& bodies);

// If a stage of kind "compact" moves tools away from the powder only.
std::vector<std::string> leaving_warnings(const Scene& scene);

// Throws SceneError where no solid could withstand the travel: the density exceeds 1.5, or tools that face each other
// meet. Not if the scene expects the run to stop.
void check_travel(const Scene& scene, const std::vector<BodySpec>& bodies);

// One line if the pressure beyond full density exceeds the yield stress of the particles.
std::vector<std::string> travel_warnings(const Scene& scene, const std::vector<BodySpec>& bodies);

// If the first stage is to end at a relative density that the powder, with `density` at the start, already has.
std::vector<std::string> until_warnings(const Scene& scene, const std::optional<double>& density);

}  // namespace pulvis
