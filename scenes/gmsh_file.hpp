// Meshes of Gmsh: MSH files, ASCII, version 2.2 or 4.1. What is kept are hexahedra and the quads of their
// surface that stand in a named physical group; points and lines are left out, and so are elements in
// no group. Format: gmsh.info/doc/texinfo/gmsh.html, section "MSH file format".
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace pulvis {

struct GmshMesh {
  struct Hexahedron {
    std::array<int, 8> corners;  // into nodes; as SolidMesh has them
    std::string group;
  };
  struct Quad {
    std::array<int, 4> corners;
    std::string group;
  };
  std::vector<Eigen::Vector3d> nodes;  // in the file's unit
  std::vector<Hexahedron> hexahedra;
  std::vector<Quad> quads;
};

// Throws SceneError: file:line: what is wrong, what is allowed. Other elements (tetrahedra, triangles, prisms,
// second order) in a named group are refused.
GmshMesh read_gmsh(const std::filesystem::path& file);

}  // namespace pulvis
