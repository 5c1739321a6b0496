// The room between the tools around a powder in three dimensions: what relative density refers to.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace pulvis {

struct DieRoom {
  enum class Kind { box, round };
  enum Side { left, right, front, back, bottom, top };  // towards -x +x -y +y -z +z; of a round die along its axis
  Kind kind = Kind::box;
  std::array<int, 6> tool{};  // by side; of a round die bottom and top alone
  int die = -1;               // of a round one: the tool
  std::array<double, 3> axis{0, 0, 1};        // of a round one, from bottom to top
  double diameter = 0;        // m, of a round one
  double in_faces = 0;        // m^3, that profiles of punches take of the room
  double particle_volume = 0;  // m^3, undeformed, of all particles

  double apart(Side low, Side high, const std::array<double, 3>& along, const double* position) const {
    const auto place = [&](Side side) { return position + 3 * tool[static_cast<std::size_t>(side)]; };
    const double *a = place(low), *b = place(high);
    return (b[0] - a[0]) * along[0] + (b[1] - a[1]) * along[1] + (b[2] - a[2]) * along[2];
  }
  // m, along the axis. `position`: of the tools, ToolPosition.
  double height(const double* position) const {
    return apart(bottom, top, kind == Kind::box ? std::array<double, 3>{0, 0, 1} : axis, position);
  }
  double width(const double* position) const { return apart(left, right, {1, 0, 0}, position); }
  double depth(const double* position) const { return apart(front, back, {0, 1, 0}, position); }
  // m^2, across the axis.
  double area(const double* position) const {
    return kind == Kind::box ? width(position) * depth(position)
                             : std::numbers::pi / 4 * diameter * diameter;
  }
  double volume(const double* position) const { return area(position) * height(position) - in_faces; }
  double density(const double* position) const { return particle_volume / volume(position); }
};

}  // namespace pulvis
