// Cells of a ball's mesh: a cubic core surrounded by six shells, each a box with integer coordinates, split
// into eight cells near the contact.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "scenes/lever/mesh/solid_draft.hpp"

namespace pulvis {

// Position of a point: three coordinates on the core's grid, or on its surface, and the distance from there
// to the ball's surface.
using BallKey = std::array<int, 4>;
using BallCell = std::array<BallKey, 8>;  // corners, in the node order of a hexahedron

class BallCells {
 public:
  // `across`: cells along an edge of the core. Coordinates are multiples of 1/fineness() of a cell.
  explicit BallCells(int across);

  static constexpr int fineness() { return 1 << 12; }
  int across() const { return across_ * fineness(); }
  int layers() const { return layers_ * fineness(); }
  const std::vector<BallCell>& cells() const { return cells_; }

  // Splits cells until none is too large, and then those that border cells less than half as
  // large.
  void divide(const std::function<bool(const BallCell&)>& too_large);
  // Points in the middle of an edge or a face of a larger cell, those of the largest cells first, and the
  // corners of that edge or face.
  struct Hanging {
    BallKey point;
    std::vector<BallKey> on;
  };
  std::vector<Hanging> hanging() const;
  // Faces on the ball's surface, their corners in cyclic order.
  std::vector<std::array<BallKey, 4>> surface() const;

 private:
  void add_core();
  void add_shells();

  int across_, layers_;
  std::vector<BallCell> cells_;
};

}  // namespace pulvis
