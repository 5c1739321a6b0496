// Meshes of Gmsh: MSH files, ASCII, version 2.2 or 4.1. What is kept are hexahedra of eight nodes, tetrahedra of
// ten, and the quads of four and triangles of six nodes of their surfaces that stand in a named physical
// group; points and lines are left out, and so are elements in no group. Format:
// gmsh.info/doc/texinfo/gmsh.html, sections "MSH file format" and "Node ordering".
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace pulvis {

struct GmshMesh {
  struct Element {
    std::vector<int> nodes;  // into nodes, in Gmsh's order
    std::string group;
    int line = 0;  // of the file
  };
  std::vector<Eigen::Vector3d> nodes;  // in the file's unit
  std::vector<Element> volumes;        // 8 nodes: hexahedra; 10: tetrahedra
  std::vector<Element> facets;         // 4 nodes: quads; 6: triangles
};

// Throws SceneError: file:line: what is wrong, what is allowed. Other elements (prisms, tetrahedra of four
// nodes) in a named group are refused.
GmshMesh read_gmsh(const std::filesystem::path& file);

}  // namespace pulvis
