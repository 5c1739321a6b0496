// A solid under construction: nodes, elements, constraints. finish_solid() converts it into the
// tables, columns and lists that the solver works on.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "components/solid.hpp"
#include "engine/world.hpp"
#include "scenes/lever/mesh/plan_mesh.hpp"

namespace pulvis {

using Vec3 = Eigen::Vector3d;

enum class SolidPart : std::uint8_t { lever, coating, tip, glue };

struct SolidDraft {
  std::vector<Vec3> nodes;  // m
  std::vector<SolidMesh::Hexahedron> hexahedra;
  std::vector<HexFormulation> formulation;  // [hexahedra]
  std::vector<std::uint8_t> part;           // [hexahedra] SolidPart
  std::vector<SolidMesh::Tetrahedron> tetrahedra;
  std::vector<std::uint8_t> tetrahedron_part;            // [tetrahedra] SolidPart
  std::vector<std::uint8_t> held;                        // [nodes]
  std::vector<std::vector<SolidMesh::Support>> hanging;  // [nodes] empty: free or held

  int add_node(const Vec3& x);
  // The supports may be hanging nodes themselves; a held node stays held.
  void hang(int node, std::vector<SolidMesh::Support> on);
  void add_hexahedron(const SolidMesh::Hexahedron& corners, SolidPart of, HexFormulation how);
  void add_tetrahedron(const SolidMesh::Tetrahedron& of_nodes, SolidPart of);
};

// Orders the corners so that the volume is positive; false where the hexahedron is folded.
bool turn_outside_out(const std::vector<Vec3>& nodes, SolidMesh::Hexahedron& corners);

struct SolidMaterial {
  double lambda = 0, mu = 0;                       // Pa
  double yield_stress = 0, hardening_modulus = 0;  // Pa; 0 0: elastic
  std::shared_ptr<const FlowLaw> flow = {};        // where the material has another flow law
};
SolidMaterial solid_material(const MaterialSpec& material);

// Tables, columns and lists of the solid; `materials` by part.
std::unique_ptr<World> finish_solid(const SolidDraft& draft,
                                    const std::array<SolidMaterial, 4>& materials);

}  // namespace pulvis
