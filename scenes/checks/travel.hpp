// How far the walls of a die travel, against the room that the powder itself takes.
//
// A die of four planes has at every moment the area between them. Where that falls below the area of the particles the
// relative density passes 1: there are no pores left, and only elastic compression of the solid gives way.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// The first stage in which prescribed moves alone take the die to full density.
struct FullDensity {
  int stage = 0;
  int tool = 0;           // that travels farthest into the die
  double travel = 0;      // m, of it over the stage
  double until_full = 0;  // m, of it when the relative density is 1
  double density = 0;     // -, at the end of the stage; infinite where the die has no room left
  double volume_strain() const { return 1 - 1 / density; }  // elastic, of the solid
};

// None where the die is no rectangle of planes, or where forces, drives that give, an `until` or an initial state
// decide how far a tool gets before full density.
std::optional<FullDensity> full_density(const Scene& scene, const std::vector<BodySpec>& bodies);

// -, of a die of four planes at its start; none for other scenes.
std::optional<double> density_at_start(const Scene& scene, const std::vector<BodySpec>& bodies);

// Throws SceneError where no solid stands the travel: the density passes 1.5, or tools meet. Not where the scene
// expects that the run stops.
void check_travel(const Scene& scene, const std::vector<BodySpec>& bodies);

// A line where the pressure beyond full density passes what the particles yield at.
std::vector<std::string> travel_warnings(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
