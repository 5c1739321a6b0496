// Gmsh meshes: MSH files, ASCII, version 2.2 or 4.1. The reader keeps hexahedra of eight nodes, tetrahedra of
// ten, and the quads of four and triangles of six nodes of their surfaces that belong to a named physical
// group; it skips points, lines and elements in no group. Format:
// gmsh.info/doc/texinfo/gmsh.html, sections "MSH file format" and "Node ordering".
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace pulvis {

struct GmshMesh {
  struct Element {
    std::vector<int> nodes;  // indices into nodes, in Gmsh's order
    std::string group;
    int line = 0;  // in the file
  };
  std::vector<Eigen::Vector3d> nodes;  // in the file's unit
  std::vector<Element> volumes;        // 8 nodes: hexahedra; 10: tetrahedra
  std::vector<Element> facets;         // 4 nodes: quads; 6: triangles
};

// Throws SceneError: file:line: what is wrong, what is allowed. Other elements (prisms, tetrahedra of four
// nodes) in a named group are rejected.
GmshMesh read_gmsh(const std::filesystem::path& file);

}  // namespace pulvis
