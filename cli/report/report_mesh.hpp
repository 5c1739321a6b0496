// What the report draws of a plane mesh: all of it, or, if it is too large to e-mail, every particle
// as a fan of triangles between its centre and points on its outline.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pulvis {

struct PlaneMesh {
  std::vector<std::int32_t> quads;  // four nodes each
  std::vector<std::int32_t> cell_particle, node_particle;
  std::vector<double> reference;  // x, y of the nodes

  std::size_t cells() const { return quads.size() / 4; }
  std::size_t nodes() const { return node_particle.size(); }
};

class DrawnMesh {
 public:
  static DrawnMesh whole(const PlaneMesh& mesh);
  // Fans of at most `sectors` triangles; holes in particles are drawn over.
  static DrawnMesh fans(const PlaneMesh& mesh, std::size_t sectors);

  const std::vector<std::int32_t>& cells() const { return cells_; }  // a triangle repeats a node
  std::size_t cell_count() const { return cells_.size() / 4; }
  std::size_t node_count() const { return first_.size() - 1; }

  // Averages over the nodes and cells that each drawn one represents.
  std::vector<double> positions(std::span<const double> xy) const;
  std::vector<double> values(std::span<const double> of_cells) const;
  // The particle of every drawn cell.
  std::vector<std::int32_t> particles(const PlaneMesh& mesh) const;

 private:
  void add_fan(const PlaneMesh& mesh, std::span<const std::int32_t> cells, std::size_t sectors);
  void add_node(std::span<const std::int32_t> mean_of);

  std::vector<std::int32_t> cells_;
  std::vector<std::int32_t> first_{0},
      nodes_;                        // drawn node k: nodes_[first_[k]] up to first_[k + 1]
  std::vector<std::int32_t> drawn_;  // drawn cell that takes the value of each mesh cell
  std::vector<double> area_;         // of each mesh cell
};

}  // namespace pulvis
