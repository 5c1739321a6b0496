// O-grid of hexahedra on a cubed sphere: a core of n * n * m elements, m along z, and layers of 2 n^2 + 4 n m between it and
// the surface.
//
// Node numbers: layer 0 is the surface, and layers continue inwards; then the core, whose rim is the innermost layer. The
// nodes of a layer are the lattice points i, j = 0..n, k = 0..m on the faces of a cube.
#pragma once

#include <array>
#include <vector>

#include "components/space/shape.hpp"

namespace pulvis::space {

using Hexahedron = std::array<Row<Node>, 8>;
using Lattice = std::array<int, 3>;

class CubedSphere {
 public:
  CubedSphere(const Lattice& divisions, int rings);

  int divisions(int axis) const { return entry(divisions_, axis); }
  int rings() const { return rings_; }
  int layer_nodes() const { return static_cast<int>(rim_.size()); }
  int nodes() const { return rings_ * layer_nodes() + static_cast<int>(number_.size()); }

  // A lattice point's coordinates, in [-1, 1]^3.
  std::array<double, 3> on_cube(const Lattice& at) const;
  // The lattice points of the nodes in a layer, and in the core.
  const std::vector<Lattice>& rim() const { return rim_; }
  Lattice core_point(int number) const;
  // Layer `rings` is the core's rim.
  int layer_node(int layer, int number) const;
  int core_node(const Lattice& at) const;

  // Of a layer, by its nodes: counter-clockwise as seen from outside.
  std::vector<std::array<int, 4>> quads() const;
  // Those at the surface first, each beneath the quad of the same number, with zeta outwards; the core last.
  std::vector<Hexahedron> hexahedra() const;

 private:
  int place(const Lattice& at) const {
    return (at[2] * (divisions_[1] + 1) + at[1]) * (divisions_[0] + 1) + at[0];
  }

  Lattice divisions_;
  int rings_;
  std::vector<Lattice> rim_;
  std::vector<int> number_;  // within a layer, [place]; -1: inside
};

}  // namespace pulvis::space
