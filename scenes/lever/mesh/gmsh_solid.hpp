// A part of a lever from a Gmsh file, ready to be added to a draft: elements by part, surfaces by name.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scenes/lever/mesh/solid_draft.hpp"

namespace pulvis {

struct GmshSolid {
  std::vector<Vec3> nodes;  // m; each of them belongs to an element
  std::vector<SolidMesh::Hexahedron> hexahedra;
  std::vector<SolidPart> hexahedron_part;
  std::vector<SolidMesh::Tetrahedron> tetrahedra;
  std::vector<SolidPart> tetrahedron_part;
  std::map<std::string, std::vector<std::vector<int>>> surfaces;  // by group: nodes of the facets

  bool has(SolidPart part) const;
  std::set<int> nodes_of(const std::string& surface) const;
};

struct GmshGroups {
  std::string key;  // the scene key that names the file
  std::map<std::string, SolidPart> volumes;
  // Surfaces that must exist, and whether they may lie between two elements.
  std::map<std::string, bool> surfaces;
};

// Hexahedra of positive volume or tetrahedra with straight edges, not both, with their surfaces. Throws
// SceneError: file:line: what is wrong, what is allowed.
GmshSolid read_gmsh_solid(const std::filesystem::path& file, double unit, const GmshGroups& groups);

[[noreturn]] void refuse_mesh(const std::filesystem::path& file, int line, const std::string& key,
                              const std::string& message);

// `root` is where the file's origin is placed; returns the number of its first node.
int add_gmsh_solid(SolidDraft& draft, const GmshSolid& solid, const Vec3& root,
                   HexFormulation formulation);

}  // namespace pulvis
