// The periodic cell of a scene, as plain values.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "scenes/language/source_mark.hpp"
#include "scenes/language/vectors.hpp"

namespace pulvis {

// A periodic cell that replaces the tools around the powder.
struct CellSpec {
  double width = 0;              // m, along its first vector: x
  std::optional<double> depth;   // m, along y; in three dimensions only
  std::optional<double> height;  // m, along its last one; absent: taken from the random packing
  Vec3 corner = Vec3::Zero();    // m, with the smallest coordinates
  double angle = 0;              // rad, of the first vector from the x axis; in two dimensions only
  SourceMark mark;
};

// Components of a symmetric tensor, in the order of MixedControl.
inline constexpr std::size_t tensor_parts = 6;
inline constexpr std::array<const char*, tensor_parts> tensor_part_names{"xx", "yy", "zz",
                                                                         "xy", "yz", "zx"};

// How the cell, or the die of planes, deforms in a stage: each component is strain-controlled or stress-controlled.
struct CellDriveSpec {
  using Parts = std::array<std::optional<double>, tensor_parts>;
  Parts strain;                        // -, over the stage; absent: 0, or stress-driven
  Parts stress;                        // Pa, tension > 0
  std::optional<double> stress_ratio;  // -, of the lateral stresses to the axial one, instead
  std::optional<double> mean_stress;   // Pa, of all normal stresses, likewise
  Vec3 rotation = Vec3::Zero();        // rad, over the stage; in two dimensions about z
  double ramp = 0.1;        // -, fraction of the stage in which the rate rises, and falls
  double rise = 0.2;        // -, fraction of the stage until a stress is prescribed in full
  double response = 0.1;    // -, inertia of the cell relative to that of the powder
  double tolerance = 0.05;  // -, of the largest stress, at the end of the stage
  SourceMark mark;

  static bool any(const Parts& parts) {
    return std::ranges::any_of(parts, [](const auto& part) { return part.has_value(); });
  }
  bool strains() const { return any(strain) || rotation != Vec3::Zero(); }
  bool stresses() const { return any(stress) || stress_ratio || mean_stress; }
};

}  // namespace pulvis
