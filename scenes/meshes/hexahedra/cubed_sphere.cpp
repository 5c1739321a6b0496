#include "scenes/meshes/hexahedra/cubed_sphere.hpp"

#include <algorithm>

namespace pulvis::space {

CubedSphere::CubedSphere(const Lattice& divisions, int rings)
    : divisions_(divisions), rings_(rings) {
  const auto is_end = [this](int i, int axis) { return i == 0 || i == this->divisions(axis); };
  for (int k = 0; k <= divisions[2]; ++k)
    for (int j = 0; j <= divisions[1]; ++j)
      for (int i = 0; i <= divisions[0]; ++i) {
        const bool outside = is_end(i, 0) || is_end(j, 1) || is_end(k, 2);
        number_.push_back(outside ? layer_nodes() : -1);
        if (outside) rim_.push_back({i, j, k});
      }
}

std::array<double, 3> CubedSphere::on_cube(const Lattice& at) const {
  const auto along = [&](int axis) { return 2.0 * entry(at, axis) / divisions(axis) - 1; };
  return {along(0), along(1), along(2)};
}

Lattice CubedSphere::core_point(int number) const {
  const int row = divisions_[0] + 1, plane = row * (divisions_[1] + 1);
  return {number % row, number % plane / row, number / plane};
}

int CubedSphere::core_node(const Lattice& at) const { return rings_ * layer_nodes() + place(at); }

int CubedSphere::layer_node(int layer, int number) const {
  return layer < rings_ ? layer * layer_nodes() + number : core_node(entry(rim_, number));
}

std::vector<std::array<int, 4>> CubedSphere::quads() const {
  std::vector<std::array<int, 4>> quads;
  for (int face = 0; face < 6; ++face) {
    const bool upper = face % 2 == 1;
    // u cross v is the outward normal.
    const int w = face / 2, u = (w + (upper ? 1 : 2)) % 3, v = (w + (upper ? 2 : 1)) % 3;
    for (int b = 0; b < divisions(v); ++b)
      for (int a = 0; a < divisions(u); ++a) {
        std::array<int, 4> quad{};
        for (int c = 0; c < 4; ++c) {
          Lattice at{};
          entry(at, u) = a + (c == 1 || c == 2 ? 1 : 0);
          entry(at, v) = b + (c >= 2 ? 1 : 0);
          entry(at, w) = upper ? divisions(w) : 0;
          entry(quad, c) = entry(number_, place(at));
        }
        quads.push_back(quad);
      }
  }
  return quads;
}

std::vector<Hexahedron> CubedSphere::hexahedra() const {
  std::vector<Hexahedron> hexahedra;
  const std::vector<std::array<int, 4>> sides = quads();
  for (int layer = 0; layer < rings_; ++layer)
    for (const auto& quad : sides) {
      Hexahedron& hexahedron = hexahedra.emplace_back();
      for (std::size_t c = 0; c < 4; ++c) {
        hexahedron[c] = Row<Node>(layer_node(layer + 1, quad[c]));
        hexahedron[c + 4] = Row<Node>(layer_node(layer, quad[c]));
      }
    }
  for (int k = 0; k < divisions_[2]; ++k)
    for (int j = 0; j < divisions_[1]; ++j)
      for (int i = 0; i < divisions_[0]; ++i) {
        Hexahedron& hexahedron = hexahedra.emplace_back();
        for (int c = 0; c < 8; ++c) {
          const int across = c % 4 == 1 || c % 4 == 2 ? 1 : 0, up = c % 4 >= 2 ? 1 : 0;
          entry(hexahedron, c) = Row<Node>(core_node({i + across, j + up, k + c / 4}));
        }
      }
  return hexahedra;
}

}  // namespace pulvis::space
