// Columns and resources of a deformable solid in space that is solved quasi-statically: eight-node hexahedra, ten-node
// tetrahedra, nodes, and the blocks of the stiffness matrix. Nothing of it is there unless the scene has a lever
// (family = "afm").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/component.hpp"
#include "engine/entry.hpp"

namespace pulvis {

struct SolidNode {
  static constexpr const char* name = "solid_node";
  static constexpr bool laned = false, by_chunk = false;
};
struct SolidElement {  // eight-node hexahedron
  static constexpr const char* name = "solid_element";
  static constexpr bool laned = false, by_chunk = true;
};
struct SolidTetrahedron {  // of ten nodes; only where a mesh from a file has them
  static constexpr const char* name = "solid_tetrahedron";
  static constexpr bool laned = false, by_chunk = true;
};
struct StiffnessBlock {  // 3 x 3 numbers: how one node's displacement acts on another's force
  static constexpr const char* name = "stiffness_block";
  static constexpr bool laned = false, by_chunk = false;
};

// ---- nodes ------------------------------------------------------------------------------------
struct ReferencePosition : Component<SolidNode, double, 3> {
  static constexpr ComponentInfo info{"reference_position", "m", "of the undeformed solid"};
};
struct Displacement : Component<SolidNode, double, 3> {
  static constexpr ComponentInfo info{"displacement", "m", "from the reference position"};
};
struct AppliedForce : Component<SolidNode, double, 3> {
  static constexpr ComponentInfo info{"applied_force", "N", "dead load on the node"};
};
struct SolidForce : Component<SolidNode, double, 3> {
  static constexpr ComponentInfo info{"solid_force", "N", "of the stresses, on the node's support"};
};

// ---- elements ---------------------------------------------------------------------------------
struct LameConstants : Component<SolidElement, double, 2> {
  static constexpr ComponentInfo info{"lame_constants", "Pa", "lambda, mu"};
};
struct ElementForce : Component<SolidElement, double, 24> {
  static constexpr ComponentInfo info{"element_force", "N", "of the stresses, by corner: x y z"};
};
struct ElementTangent : Component<SolidElement, double, 300> {
  static constexpr ComponentInfo info{"element_tangent", "N/m",
                                      "d force / d displacement, lower triangle row by row"};
};
struct ElementEnergy : Component<SolidElement, double, 1> {
  static constexpr ComponentInfo info{"element_energy", "J", "strain energy"};
};

struct TetrahedronLame : Component<SolidTetrahedron, double, 2> {
  static constexpr ComponentInfo info{"tetrahedron_lame", "Pa", "lambda, mu"};
};
struct TetrahedronForce : Component<SolidTetrahedron, double, 30> {
  static constexpr ComponentInfo info{"tetrahedron_force", "N", "of the stresses, by node: x y z"};
};
struct TetrahedronTangent : Component<SolidTetrahedron, double, 465> {
  static constexpr ComponentInfo info{"tetrahedron_tangent", "N/m",
                                      "d force / d displacement, lower triangle row by row"};
};
struct TetrahedronEnergy : Component<SolidTetrahedron, double, 1> {
  static constexpr ComponentInfo info{"tetrahedron_energy", "J", "strain energy"};
};

// Only where a material of the solid yields.
struct SolidYield : Component<SolidElement, double, 2> {
  static constexpr ComponentInfo info{"solid_yield", "Pa",
                                      "yield stress, hardening modulus; 0 0: elastic"};
};
struct SolidMemory : Component<SolidElement, double, 56> {
  static constexpr ComponentInfo info{"solid_memory", "-",
                                      "by Gauss point: plastic strain 11 22 33 2*12 2*23 2*13, "
                                      "accumulated plastic strain; of the last equilibrium"};
};

// ---- the stiffness matrix ---------------------------------------------------------------------
struct BlockTangent : Component<StiffnessBlock, double, 9> {
  static constexpr ComponentInfo info{"block_tangent", "N/m", "3 x 3, row by row"};
};

// How a hexahedron takes its strains from its corners' displacements; systems/lever/solid_kernel.hpp.
enum class HexFormulation : std::uint8_t {
  solid,     // nine incompatible modes
  plate,     // one layer of a plate, thin along zeta: modes, and transverse shear from its edges
  standard,  // trilinear displacements alone: locks where it bends
};

// Hexahedra: corners 0-3 counter-clockwise at zeta = -1 seen from +zeta, 4-7 above them. Tetrahedra: corners
// 0-3, 3 where 0-1-2 run counter-clockwise away from it, then the middles of the edges 01 12 02 03 23 13.
struct SolidMesh {
  static constexpr const char* resource_name = "solid_mesh";
  static constexpr bool fixed = true;
  using Hexahedron = std::array<std::int32_t, 8>;
  using Tetrahedron = std::array<std::int32_t, 10>;
  // A node that hangs on others moves as their weighted mean; one that hangs on nobody is held.
  struct Support {
    std::int32_t node = 0;
    double weight = 1;
  };
  std::vector<Hexahedron> hexahedra;
  std::vector<HexFormulation> formulation;  // [elements]
  std::vector<std::uint8_t> part;           // [elements] 0 lever, 1 coating, 2 tip, 3 glue
  std::vector<Tetrahedron> tetrahedra;
  std::vector<std::uint8_t> tetrahedron_part;  // [tetrahedra]
  std::vector<std::int32_t> support_begin;     // [nodes + 1]; a free node's only support is itself
  std::vector<Support> supports;
  std::vector<std::int32_t> unknown;      // [nodes] block of three equations; -1: held or hanging
  std::int32_t unknowns = 0;              // free nodes
  std::vector<std::int32_t> chunk_begin;  // [chunks + 1] into hexahedra
  std::vector<std::int32_t> tetrahedron_begin;  // [chunks + 1] into tetrahedra

  std::span<const Support> supports_of(int node) const {
    return entries(supports, support_begin, node);
  }
  // Of the three equations of a free node.
  int first_equation(int node) const { return 3 * entry(unknown, node); }
};

// Where the numbers of the elements go: lists made once, added up in their order, whatever the threads.
struct SolidAssembly {
  static constexpr const char* resource_name = "solid_assembly";
  static constexpr bool fixed = true;
  struct Share {
    std::int32_t element = 0;
    std::int8_t row = 0, column = 0;  // of its nodes; of a force: row
    bool tetrahedron = false;
    double weight = 1;
  };
  std::vector<std::int32_t> force_begin;  // [nodes + 1] into forces
  std::vector<Share> forces;
  std::vector<std::int32_t> block_begin;  // [blocks + 1] into shares
  std::vector<Share> shares;
  std::vector<std::int32_t>
      column_begin;  // [unknowns + 1] into block_row: lower triangle by columns
  std::vector<std::int32_t> block_row;

  std::span<const Share> forces_of(int node) const { return entries(forces, force_begin, node); }
  std::span<const Share> shares_of(int block) const { return entries(shares, block_begin, block); }
  int columns() const { return static_cast<int>(column_begin.size()) - 1; }
  // The rows of a column's blocks, in rising order; the first is the diagonal's.
  std::span<const std::int32_t> rows_of(int column) const {
    return entries(block_row, column_begin, column);
  }
};

}  // namespace pulvis
