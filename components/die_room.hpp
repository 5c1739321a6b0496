// The space enclosed by the tools in three dimensions: the reference of relative density.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>

namespace pulvis {

struct DieRoom {
  enum class Kind { box, round };
  // Outward directions -x +x -y +y -z +z; a round die has only bottom and top, along its axis.
  enum Side : std::size_t { left, right, front, back, bottom, top };
  using Vector = std::array<double, 3>;

  Kind kind = Kind::box;
  std::array<int, 6> tool{};         // by side
  int die = -1;                      // tool number of a round die
  Vector axis{0, 0, 1};              // from bottom to top
  double diameter = 0;               // m, of a round die
  std::optional<double> mouth = {};  // m, height of its end above its position
  double in_faces = 0;               // m^3 of the room occupied by the profiles of punches
  double particle_volume = 0;        // m^3, undeformed, of all particles

  // m, distance between two sides. `at`: at(tool, component) is the current position of a tool.
  template <class At>
  double apart(Side low, Side high, const Vector& along, const At& at) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += (at(tool[high], static_cast<int>(k)) - at(tool[low], static_cast<int>(k))) * along[k];
    return sum;
  }
  template <class At>
  double height(const At& at) const {
    return apart(bottom, top, axis, at);
  }
  template <class At>
  double width(const At& at) const {
    return apart(left, right, {1, 0, 0}, at);
  }
  template <class At>
  double depth(const At& at) const {
    return apart(front, back, {0, 1, 0}, at);
  }
  // m^2, cross section normal to the axis.
  template <class At>
  double area(const At& at) const {
    if (kind == Kind::box) return width(at) * depth(at);
    return std::numbers::pi / 4 * diameter * diameter;
  }
  // m^2, inner surface of a round die between the two other tools, up to its mouth.
  template <class At>
  double wall(const At& at) const {
    double length = height(at);
    if (mouth) {
      double above_bottom = *mouth;
      for (std::size_t k = 0; k < 3; ++k)
        above_bottom +=
            (at(die, static_cast<int>(k)) - at(tool[bottom], static_cast<int>(k))) * axis[k];
      length = std::min(length, std::max(above_bottom, 0.0));
    }
    return std::numbers::pi * diameter * length;
  }
  template <class At>
  double volume(const At& at) const {
    return area(at) * height(at) - in_faces;
  }
  template <class At>
  double density(const At& at) const {
    return particle_volume / volume(at);
  }
};

}  // namespace pulvis
