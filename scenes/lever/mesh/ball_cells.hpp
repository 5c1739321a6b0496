// Cells of a ball's mesh: a cubic core in six shells, each a box of whole numbers, which are divided in eight
// where the ball touches.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "scenes/lever/mesh/solid_draft.hpp"

namespace pulvis {

// Where a point lies: three numbers on the core's grid, or on its surface, and how far it is from there
// to the ball's surface.
using BallKey = std::array<int, 4>;
using BallCell = std::array<BallKey, 8>;  // corners, in the order of a hexahedron's

class BallCells {
 public:
  // `across`: cells along an edge of the core. Numbers are multiples of 1/fineness() of a cell.
  explicit BallCells(int across);

  static constexpr int fineness() { return 1 << 12; }
  int across() const { return across_ * fineness(); }
  int layers() const { return layers_ * fineness(); }
  const std::vector<BallCell>& cells() const { return cells_; }

  // Divides cells for as long as they are wanted smaller, and then those that meet others less than half as
  // large.
  void divide(const std::function<bool(const BallCell&)>& too_large);
  // Points that lie in the middle of an edge or a face of a larger cell, those of the largest first, and the
  // corners of that.
  struct Hanging {
    BallKey point;
    std::vector<BallKey> on;
  };
  std::vector<Hanging> hanging() const;
  // Faces on the ball's surface, their corners in turn.
  std::vector<std::array<BallKey, 4>> surface() const;

 private:
  void add_core();
  void add_shells();

  int across_, layers_;
  std::vector<BallCell> cells_;
};

}  // namespace pulvis
