// The periodic cell of a scene, as plain values.
#pragma once

#include <optional>

#include "scenes/language/source_mark.hpp"
#include "scenes/language/vectors.hpp"

namespace pulvis {

// A periodic cell that replaces the tools around the powder.
struct CellSpec {
  double width = 0;              // m, along its first vector
  std::optional<double> height;  // m, along its second one; absent: taken from the random packing
  Vec2 corner = Vec2::Zero();    // m, lower left
  double angle = 0;              // rad, of the first vector from the x axis
  SourceMark mark;
};

// How the cell, or the die of four planes, deforms in a stage: each component is strain-controlled or stress-controlled.
struct CellDriveSpec {
  std::optional<double> strain_xx, strain_yy,
      strain_xy;  // -, over the stage; absent: 0, or stress-driven
  std::optional<double> stress_xx, stress_yy, stress_xy;  // Pa, tension > 0
  std::optional<double> stress_ratio;  // -, of xx to yy, instead of strain or stress xx
  std::optional<double> mean_stress;   // Pa, of xx and yy, likewise
  double rotation = 0;                 // rad, over the stage
  double ramp = 0.1;        // -, fraction of the stage in which the rate rises, and falls
  double rise = 0.2;        // -, fraction of the stage until a stress is prescribed in full
  double response = 0.1;    // -, inertia of the cell relative to that of the powder
  double tolerance = 0.05;  // -, of the largest stress, at the end of the stage
  SourceMark mark;
};

}  // namespace pulvis
