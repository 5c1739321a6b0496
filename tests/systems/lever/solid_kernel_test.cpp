// The hexahedron: patches of distorted elements carry constant states, tangents are derivatives, and
// nothing depends on where the solid stands in space.
#include "systems/lever/solid_kernel.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <vector>

namespace pulvis::kernels {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Patch {
  std::vector<Vector3d> nodes;
  std::vector<std::array<int, 8>> elements;
  std::vector<int> inner;  // nodes that no neighbour outside of the patch would touch
};

// MacNeal and Harder (1985), fig. 3: a unit cube of seven hexahedra, none of them regular.
Patch cube_patch() {
  Patch p;
  p.nodes = {{.249, .342, .192}, {.826, .288, .288}, {.850, .649, .263}, {.273, .750, .230},
             {.320, .186, .643}, {.677, .305, .683}, {.788, .693, .644}, {.165, .745, .702}};
  for (const auto& s : corner_sign)
    p.nodes.emplace_back(0.5 * (1 + s[0]), 0.5 * (1 + s[1]), 0.5 * (1 + s[2]));
  p.elements.push_back({0, 1, 2, 3, 4, 5, 6, 7});
  // A face of the inner element and the face of the cube outside of it.
  const std::array<std::array<int, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {3, 0, 4, 7}}};
  for (const auto& f : faces)
    p.elements.push_back({f[0], f[1], f[2], f[3], f[0] + 8, f[1] + 8, f[2] + 8, f[3] + 8});
  p.inner = {0, 1, 2, 3, 4, 5, 6, 7};
  return p;
}

// MacNeal and Harder (1985), fig. 2: five quads in a rectangle 0.24 x 0.12, one layer 0.001 thick.
Patch plate_patch() {
  const std::vector<std::array<double, 2>> plan{{.04, .02}, {.18, .03}, {.16, .08}, {.08, .08},
                                                {0, 0},     {.24, 0},   {.24, .12}, {0, .12}};
  Patch p;
  for (const double z : {-0.0005, 0.0005})
    for (const auto& x : plan) p.nodes.emplace_back(x[0], x[1], z);
  const std::array<std::array<int, 4>, 5> quads{
      {{0, 1, 2, 3}, {4, 5, 1, 0}, {5, 6, 2, 1}, {6, 7, 3, 2}, {7, 4, 0, 3}}};
  for (const auto& q : quads)
    p.elements.push_back({q[0], q[1], q[2], q[3], q[0] + 8, q[1] + 8, q[2] + 8, q[3] + 8});
  p.inner = {0, 1, 2, 3, 8, 9, 10, 11};
  return p;
}

constexpr double lambda = 1.2e6, mu = 0.8e6;

struct PatchForces {
  double imbalance = 0, energy = 0;
};

// Largest force on an inner node over the largest on any corner, where every node moves by `field`.
PatchForces forces_of(const Patch& patch, HexFormulation formulation,
                      const std::function<Vector3d(const Vector3d&)>& field) {
  std::vector<Vector3d> force(patch.nodes.size(), Vector3d::Zero());
  PatchForces result;
  double largest = 0;
  for (const auto& element : patch.elements) {
    Corners x, u;
    for (int a = 0; a < 8; ++a) {
      x.col(a) = patch.nodes[static_cast<std::size_t>(element[static_cast<std::size_t>(a)])];
      u.col(a) = field(x.col(a));
    }
    const HexResponse r = hex_response(x, u, lambda, mu, formulation);
    EXPECT_GT(r.min_determinant, 0);
    result.energy += r.energy;
    for (int a = 0; a < 8; ++a) {
      const Vector3d f = r.force.segment<3>(3 * a);
      force[static_cast<std::size_t>(element[static_cast<std::size_t>(a)])] += f;
      largest = std::max(largest, f.norm());
    }
  }
  for (const int n : patch.inner)
    result.imbalance = std::max(result.imbalance, force[static_cast<std::size_t>(n)].norm());
  result.imbalance /= largest;
  return result;
}

TEST(SolidKernel, APatchOfDistortedElementsCarriesAConstantStrain) {
  Matrix3d g;
  g << 1.0, 0.4, -0.3, 0.2, -0.7, 0.5, 0.6, 0.1, 0.9;
  g *= 1e-6;
  const auto r = forces_of(cube_patch(), HexFormulation::solid,
                           [&](const Vector3d& x) -> Vector3d { return g * x; });
  EXPECT_LT(r.imbalance, 1e-13);
  const Matrix3d e = 0.5 * (g + g.transpose());
  const double energy = 0.5 * lambda * e.trace() * e.trace() + mu * e.squaredNorm();
  EXPECT_NEAR(r.energy / energy, 1, 1e-5);  // Green-Lagrange: quadratic terms of 1e-6
}

// Strains of 1e-3 in a sheet whose faces are free: the thickness changes so that the stress through it is
// nothing, in the Green-Lagrange strain, whose quadratic terms the wide faces would feel.
TEST(SolidKernel, AThinPatchCarriesAConstantMembraneStrain) {
  Matrix3d g = Matrix3d::Zero();
  g(0, 0) = 1e-3, g(0, 1) = 0.4e-3, g(1, 0) = 0.7e-3, g(1, 1) = -0.5e-3;
  const Matrix3d e = 0.5 * (g + g.transpose() + g.transpose() * g);
  const double through = -lambda / (lambda + 2 * mu) * (e(0, 0) + e(1, 1));
  g(2, 2) = 2 * through / (1 + std::sqrt(1 + 2 * through));
  const auto r = forces_of(plate_patch(), HexFormulation::plate,
                           [&](const Vector3d& x) -> Vector3d { return g * x; });
  EXPECT_LT(r.imbalance, 1e-12);
}

// w = (x^2 + xy + y^2)/2 and the rotations that go with it: constant curvatures and twist. What is left is
// the rounding of w itself: 1e-16 w over the thickness t, as a shear over the plate's curvature times t.
TEST(SolidKernel, AThinPatchOfTaperedQuadsCarriesConstantBending) {
  constexpr double scale = 1e-20;  // w_x^2 is then nothing beside z w_xx
  const auto r =
      forces_of(plate_patch(), HexFormulation::plate, [&](const Vector3d& x) -> Vector3d {
        return Vector3d(-x.z() * (x.x() + 0.5 * x.y()), -x.z() * (x.y() + 0.5 * x.x()),
                        0.5 * (x.x() * x.x() + x.x() * x.y() + x.y() * x.y())) *
               scale;
      });
  EXPECT_LT(r.imbalance, 1e-10);
  // Plate theory: D/2 [k_x^2 + k_y^2 + 2 nu k_x k_y + 2 (1 - nu) k_xy^2] a, k = (1, 1, 1/2).
  const double e = mu * (3 * lambda + 2 * mu) / (lambda + mu), nu = 0.5 * lambda / (lambda + mu);
  const double d = e * 1e-9 / (12 * (1 - nu * nu));
  const double plate = 0.5 * d * (2 + 2 * nu + 2 * (1 - nu) * 0.25) * 0.24 * 0.12 * scale * scale;
  EXPECT_NEAR(r.energy / plate, 1, 1e-9);
}

Corners distorted_corners() {
  Corners x;
  for (int a = 0; a < 8; ++a)
    for (int k = 0; k < 3; ++k)
      x(k, a) = corner_sign[a][k] * (1 + 0.1 * k) + 0.13 * std::sin(3.0 * a + 1.7 * k);
  return x;
}

Corners large_displacements() {
  Corners u;
  for (int a = 0; a < 8; ++a)
    for (int k = 0; k < 3; ++k) u(k, a) = 0.2 * std::cos(2.0 * a + 0.9 * k);
  return u;
}

TEST(SolidKernel, ForceIsTheDerivativeOfEnergyAndTangentThatOfForce) {
  for (const HexFormulation formulation : {HexFormulation::solid, HexFormulation::plate}) {
    const Corners x = distorted_corners();
    const Corners u = large_displacements();
    const HexResponse at = hex_response(x, u, 1.2, 0.8, formulation);
    EXPECT_LT((at.tangent - at.tangent.transpose()).norm(), 1e-13 * at.tangent.norm());
    constexpr double h = 1e-6;
    for (int i = 0; i < 24; ++i) {
      Corners up = u, down = u;
      up(i % 3, i / 3) += h;
      down(i % 3, i / 3) -= h;
      const HexResponse a = hex_response(x, up, 1.2, 0.8, formulation);
      const HexResponse b = hex_response(x, down, 1.2, 0.8, formulation);
      EXPECT_NEAR((a.energy - b.energy) / (2 * h), at.force[i], 1e-8);
      EXPECT_LT(((a.force - b.force) / (2 * h) - at.tangent.col(i)).norm(),
                1e-8 * at.tangent.norm());
    }
  }
}

TEST(SolidKernel, ARotationOfAnySizeStrainsNothingAndTurnsTheForces) {
  const Matrix3d q = Eigen::AngleAxisd(2.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const HexFormulation formulation : {HexFormulation::solid, HexFormulation::plate}) {
    const Corners x = distorted_corners(), u = large_displacements();
    const HexResponse turned = hex_response(x, q * x - x, 1.2, 0.8, formulation);
    EXPECT_LT(turned.force.norm(), 1e-13);
    const HexResponse before = hex_response(x, u, 1.2, 0.8, formulation);
    const HexResponse after = hex_response(x, q * (x + u) - x, 1.2, 0.8, formulation);
    EXPECT_NEAR(after.energy, before.energy, 1e-13 * before.energy);
    for (int a = 0; a < 8; ++a)
      EXPECT_LT((after.force.segment<3>(3 * a) - q * before.force.segment<3>(3 * a)).norm(),
                1e-12 * before.force.norm());
  }
}

TEST(SolidKernel, AnElementAtRestHasSixFreeMotionsAndNoMore) {
  for (const HexFormulation formulation : {HexFormulation::solid, HexFormulation::plate}) {
    const HexResponse r = hex_response(distorted_corners(), Corners::Zero(), 1.2, 0.8, formulation);
    const Eigen::SelfAdjointEigenSolver<HexKernel<double>::NodalMatrix> eigen(r.tangent);
    EXPECT_LT(std::abs(eigen.eigenvalues()[5]), 1e-12);
    EXPECT_GT(eigen.eigenvalues()[6], 1e-3);
  }
}

}  // namespace
}  // namespace pulvis::kernels
