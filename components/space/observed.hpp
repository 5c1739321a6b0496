// Local densities in three dimensions. Written in sampled steps only; nothing in a step reads them.
#pragma once

#include <array>
#include <vector>

#include "components/die_room.hpp"

namespace pulvis::space {

// ---- output.density_cells ---------------------------------------------------------------------------
struct DensityGrid {
  static constexpr const char* resource_name = "density_grid";
  // The face of a punch: distances from its axis, and heights above its centre, along its normal, m.
  using Profile = std::vector<std::array<double, 2>>;

  std::array<int, 3> cells{};           // along x, y, z
  DieRoom between;                      // the tools
  std::array<Profile, 2> bottom_top{};  // of a round room; empty if flat

  // As last observed.
  std::array<double, 3> low{}, high{};  // m
  std::vector<double> filled;           // m^3, [z * y * x]: particle volume in a cell
  std::vector<double> room;             // m^3, volume of the cell between the tools

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(low, high, filled, room);
  }
};

}  // namespace pulvis::space
