// The room between the tools in the cells of a grid: of a box all of each cell, of a round die what lies in the circle and
// between the faces of the punches.
//
// Law      a ring of the die has the area in a cell that its two circles differ by; over it stands the part of the cell that
//          is above the lower face and below the upper one. Faces are straight between the points of their profiles, as for
//          the volume of the room; flat ones need one ring alone
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
  std::size_t axis = 2;          // that of the grid which its own lies along
  std::array<double, 2> centre;  // m, on the two following axes
  double bottom = 0, top = 0;    // m, of the middles of the faces
  const DensityGrid::Profile &low_face, &high_face;

  static constexpr int rings_of_a_profile = 256;

  // m^3, in a cell that is as long as this along each axis.
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
