#include "scenes/checks/solids/solid_particles.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "scenes/checks/solids/shape_checks.hpp"
#include "scenes/checks/solids/stl_files.hpp"

namespace pulvis::space {
namespace {

// Of a particle. Its nodes are smoothed all at once, in some ten seconds; the cache of shapes has room for two of them.
constexpr std::int64_t max_hexahedra_of_one = 100'000;

void check_solid(const ParticleSpec& of, const std::string& path, const Refuse& refuse) {
  check_shape(of.shape, path, refuse);
  // Either there is a four-face node between two corners of the cube, or on none of its edges.
  if (of.hex_mesh.axial_divisions && of.hex_mesh.divisions < 2)
    refuse(path + ".mesh.axial_divisions", "needs divisions of at least 2");
  if (of.hex_mesh.hexahedra() > max_hexahedra_of_one)
    refuse(path + ".mesh.divisions",
           fmt::format("the mesh has {} elements with rings = {}, and takes too long to make, "
                       "allowed: at most {}, as with divisions = 24 and rings = 24",
                       of.hex_mesh.hexahedra(), of.hex_mesh.rings, max_hexahedra_of_one));
  const auto* cylinder = std::get_if<CylinderShape>(&of.shape);
  if (cylinder != nullptr && of.hex_mesh.grid == HexMeshSpec::Grid::extruded)
    check_extruded(*cylinder, of.hex_mesh, path, refuse);
}

}  // namespace

void complete_solids(Scene& scene, const Refuse& refuse) {
  read_stl_files(scene, refuse);
  for (std::size_t i = 0; i < scene.particles.size(); ++i)
    check_solid(scene.particles[i], fmt::format("particle[{}]", i), refuse);
}

}  // namespace pulvis::space
