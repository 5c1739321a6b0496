// The space between the tools in the cells of a grid: for a box the whole cell, for a round die the part inside the circle
// and between the faces of the punches.
//
// Law      the area of a ring of the die in a cell is the difference of its two circles; its height is the part of the cell
//          above the lower face and below the upper one. Faces are linear between the points of their profiles, as for
//          the volume of the room; flat faces need only one ring
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "components/space/observed.hpp"
#include "systems/space/observe/cell_volume_kernel.hpp"

namespace pulvis::space::kernels {

inline double height_at(const DensityGrid::Profile& profile, double radius) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const auto& [r, h] = profile[i - 1];
    const auto& [s, k] = profile[i];
    if (radius <= s) return h + (k - h) * (radius - r) / (s - r);
  }
  return profile.empty() ? 0 : profile.back()[1];
}

struct RoundRoom {
  double radius = 0;
  std::size_t axis = 2;          // grid axis parallel to the die axis
  std::array<double, 2> centre;  // m, on the next two axes
  double bottom = 0, top = 0;    // m, at the centres of the faces
  const DensityGrid::Profile &low_face, &high_face;

  static constexpr int rings_of_a_profile = 256;

  // m^3, in a cell with these bounds along each axis.
  double in_cell(const std::array<std::array<double, 2>, 3>& cell) const {
    const std::array<double, 2>&b = cell[(axis + 1) % 3], &c = cell[(axis + 2) % 3];
    const std::array<double, 2> x{b[0] - centre[0], b[1] - centre[0]},
        y{c[0] - centre[1], c[1] - centre[1]};
    const bool flat = low_face.empty() && high_face.empty();
    const int rings = flat ? 1 : rings_of_a_profile;
    double volume = 0, inside = 0;
    for (int ring = 1; ring <= rings; ++ring) {
      const double area = circle_in_rectangle(radius * ring / rings, x, y);
      const double middle = radius * (ring - 0.5) / rings;
      const double from = std::max(cell[axis][0], bottom + height_at(low_face, middle));
      const double to = std::min(cell[axis][1], top - height_at(high_face, middle));
      volume += (area - inside) * std::max(0.0, to - from);
      inside = area;
    }
    return volume;
  }
};

}  // namespace pulvis::space::kernels
