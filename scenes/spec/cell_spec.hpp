// The periodic cell of a scene, as plain values.
#pragma once

#include <optional>

#include "scenes/language/source_mark.hpp"
#include "scenes/language/vec2.hpp"

namespace pulvis {

// A periodic cell instead of tools around the powder.
struct CellSpec {
  double width = 0;              // m, along its first vector
  std::optional<double> height;  // m, along its second one; absent: that of the random packing
  Vec2 corner = Vec2::Zero();    // m, lower left
  double angle = 0;              // rad, of the first vector from the x axis
  SourceMark mark;
};

// How the cell, or the die of four planes, deforms in a stage: each part of the rate of deformation follows a strain or keeps a stress.
struct CellDriveSpec {
  std::optional<double> strain_xx, strain_yy,
      strain_xy;  // -, over the stage; absent: 0, or stress-driven
  std::optional<double> stress_xx, stress_yy, stress_xy;  // Pa, tension > 0
  std::optional<double> stress_ratio;  // -, of xx to yy, instead of strain or stress xx
  std::optional<double> mean_stress;   // Pa, of xx and yy, the same
  double rotation = 0;                 // rad, over the stage
  double ramp = 0.1;                   // -, share of the stage in which the rate rises, and falls
  double rise = 0.2;                   // -, share of the stage until a stress is asked for in full
  double response = 0.1;               // -, inertia of the cell over that of the powder
  double tolerance = 0.05;             // -, of the largest stress, at the end of the stage
  SourceMark mark;
};

}  // namespace pulvis
