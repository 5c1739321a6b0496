#include "scenes/checks/solids/shape_checks.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "scenes/meshes/hexahedra/rounded_polyhedron.hpp"

namespace pulvis::space {
namespace {

void check_sizes(const SphereShape&, const std::string&, const Refuse&) {}
void check_sizes(const EllipsoidShape&, const std::string&, const Refuse&) {}
void check_sizes(const SuperquadricShape&, const std::string&, const Refuse&) {}
void check_sizes(const StlShape&, const std::string&, const Refuse&) {}  // checked at reading

void check_sizes(const CylinderShape& cylinder, const std::string& path, const Refuse& refuse) {
  const double most = std::min(cylinder.diameter, cylinder.height) / 2;
  if (cylinder.rounding > most)
    refuse(
        path + ".rounding",
        fmt::format("{:g} m is more than half of the diameter or of the height, allowed: <= {:g} "
                    "m",
                    cylinder.rounding, most));
}

// m, minimum extent over the directions that the corners span; 0: they are coplanar.
double thickness_of(const std::vector<Vec3>& corners) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& corner : corners) mean += corner / static_cast<double>(corners.size());
  Eigen::Matrix3Xd spread(3, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i)
    spread.col(static_cast<Eigen::Index>(i)) = corners[i] - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squares(spread * spread.transpose());
  // Not the root of its eigenvalue, which cannot distinguish 1e-9 from round-off.
  const double least = (squares.eigenvectors().col(0).transpose() * spread).norm();
  return least > 1e-9 * spread.norm() ? least : 0;
}

void check_sizes(const PolyhedronShape& polyhedron, const std::string& path, const Refuse& refuse) {
  constexpr std::size_t fewest = 4;
  if (polyhedron.corners.size() < fewest)
    refuse(path + ".corners", fmt::format("{} points have no volume, allowed: at least {}",
                                          polyhedron.corners.size(), fewest));
  else if (thickness_of(polyhedron.corners) == 0)
    refuse(path + ".corners",
           "they lie in one plane, allowed: at least four points that enclose a volume");
  else if (const auto most = too_round(polyhedron))
    refuse(path + ".rounding",
           fmt::format("{:g} m leaves nothing of the polyhedron, allowed: below {:.4g} m, the "
                       "radius of its largest inscribed sphere",
                       polyhedron.rounding, *most));
}

}  // namespace

void check_shape(const ParticleShape& shape, const std::string& path, const Refuse& refuse) {
  std::visit([&](const auto& one) { check_sizes(one, path, refuse); }, shape);
}

void check_extruded(const CylinderShape& cylinder, const HexMeshSpec& mesh, const std::string& path,
                    const Refuse& refuse) {
  if (mesh.divisions < 2)
    refuse(path + ".mesh.grid",
           "\"extruded\" needs a node between the corners of its square, allowed: divisions of at "
           "least 2");
  const double most = 0.5 * std::min(cylinder.diameter / (mesh.divisions + 2 * mesh.rings),
                                     cylinder.height / mesh.axial());
  if (cylinder.rounding > most)
    refuse(path + ".rounding",
           fmt::format("{:g} m is more than half of an element, which would degenerate at the rim "
                       "with grid = \"extruded\", allowed: <= {:g} m",
                       cylinder.rounding, most));
}

}  // namespace pulvis::space
