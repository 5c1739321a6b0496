// Columns and resources of a deformable solid in space that is solved quasi-statically: eight-node hexahedra, ten-node
// tetrahedra, nodes, and the blocks of the stiffness matrix. Present only if the scene has a cantilever
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
struct SolidTetrahedron {  // ten-node tetrahedron; only if a mesh file contains them
  static constexpr const char* name = "solid_tetrahedron";
  static constexpr bool laned = false, by_chunk = true;
};
struct StiffnessBlock {  // 3 x 3 numbers: couples displacements of one node to forces on another
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

// Only if a material of the solid is plastic.
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

// How a hexahedron's strains follow from its nodal displacements; systems/lever/solid_kernel.hpp.
enum class HexFormulation : std::uint8_t {
  solid,     // nine incompatible modes
  plate,     // one layer of a plate, thin along zeta: modes, and edge-sampled transverse shear
  standard,  // trilinear displacements only: locks in bending
};

// Hexahedra: corners 0-3 counter-clockwise at zeta = -1 seen from +zeta, 4-7 above them. Tetrahedra: corners
// 0-3, with 0-1-2 counter-clockwise seen from 3, then the midside nodes 01 12 02 03 23 13.
struct SolidMesh {
  static constexpr const char* resource_name = "solid_mesh";
  static constexpr bool fixed = true;
  using Hexahedron = std::array<std::int32_t, 8>;
  using Tetrahedron = std::array<std::int32_t, 10>;
  // A dependent node moves as the weighted mean of its supports; a node without supports is fixed.
  struct Support {
    std::int32_t node = 0;
    double weight = 1;
  };
  std::vector<Hexahedron> hexahedra;
  std::vector<HexFormulation> formulation;  // [elements]
  std::vector<std::uint8_t> part;           // [elements] 0 lever, 1 coating, 2 tip, 3 glue
  std::vector<Tetrahedron> tetrahedra;
  std::vector<std::uint8_t> tetrahedron_part;  // [tetrahedra]
  std::vector<std::int32_t> support_begin;     // [nodes + 1]; a free node is its only support
  std::vector<Support> supports;
  std::vector<std::int32_t> unknown;      // [nodes] block of three equations; -1: fixed, dependent
  std::int32_t unknowns = 0;              // free nodes
  std::vector<std::int32_t> chunk_begin;  // [chunks + 1] into hexahedra
  std::vector<std::int32_t> tetrahedron_begin;  // [chunks + 1] into tetrahedra

  std::span<const Support> supports_of(int node) const {
    return entries(supports, support_begin, node);
  }
  // First of the three equations of a free node.
  int first_equation(int node) const { return 3 * entry(unknown, node); }
};

// Where element contributions are added: lists built once, summed in fixed order, whatever the threads.
struct SolidAssembly {
  static constexpr const char* resource_name = "solid_assembly";
  static constexpr bool fixed = true;
  struct Share {
    std::int32_t element = 0;
    std::int8_t row = 0, column = 0;  // local node numbers; for a force: row
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
  // Rows of the blocks in a column, ascending; the first is the diagonal block.
  std::span<const std::int32_t> rows_of(int column) const {
    return entries(block_row, column_begin, column);
  }
};

}  // namespace pulvis
