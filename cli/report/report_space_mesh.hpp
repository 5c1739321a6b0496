// What the report draws of particles in three dimensions: all hexahedra, or, if the mesh is too large to e-mail,
// every particle as pyramids between its centre and the faces of its surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pulvis {

// Corners of a hexahedron's sides, counter-clockwise seen from outside; duplicated in page/space/.
inline constexpr std::array<std::array<std::size_t, 4>, 6> sides_of_hexahedron{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

struct SpaceMesh {
  std::vector<std::int32_t> hexahedra;  // eight nodes each
  std::vector<std::int32_t> cell_particle, node_particle;
  std::vector<double> reference;  // x, y, z of the nodes

  std::size_t cells() const { return cell_particle.size(); }
  std::size_t nodes() const { return node_particle.size(); }
};

// Sides that belong to only one hexahedron, as 6 * hexahedron + side, in this order.
std::vector<std::int32_t> outer_sides(std::span<const std::int32_t> hexahedra);

class DrawnSpace {
 public:
  static DrawnSpace whole(const SpaceMesh& mesh);
  static DrawnSpace pyramids(const SpaceMesh& mesh);

  // Eight nodes each; a pyramid repeats its apex four times.
  const std::vector<std::int32_t>& cells() const { return cells_; }
  const std::vector<std::int32_t>& surface() const { return surface_; }      // 6 * cell + side
  const std::vector<std::int32_t>& particles() const { return particles_; }  // of the cells
  std::size_t cell_count() const { return particles_.size(); }
  std::size_t node_count() const { return first_.size() - 1; }

  // Averages over the nodes that each drawn one represents.
  std::vector<double> positions(std::span<const double> xyz) const;
  std::vector<double> values(std::span<const double> of_cells) const;

 private:
  void add_node(std::span<const std::int32_t> mean_of);
  void add_particle(const SpaceMesh& mesh, std::span<const std::int32_t> sides,
                    std::span<const std::int32_t> cells);

  std::vector<std::int32_t> cells_, surface_, particles_;
  std::vector<std::int32_t> first_{0},
      nodes_;  // drawn node k: nodes_[first_[k]] up to first_[k + 1]
  struct Share {
    std::int32_t cell, drawn;  // drawn cells that take the value of a mesh cell: one or several
  };
  std::vector<Share> shares_;
  std::vector<double> volume_;  // of each mesh cell
};

// m^3, of a hexahedron whose corners are these rows of `xyz`: by the midpoint rule over its eight parts.
double hexahedron_volume(std::span<const double> xyz, std::span<const std::int32_t> corners);

}  // namespace pulvis
