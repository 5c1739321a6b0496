// The tetrahedron of ten nodes: a patch of them carries constant strain and pure bending to round-off, it has six
// rigid motions and no more, and its tangent is the derivative of its forces.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "systems/lever/solid_tetrahedron_kernel.hpp"

namespace pulvis::kernels {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double lambda = 1.2e6, mu = 0.8e6;

struct Patch {
  std::vector<Vector3d> nodes;
  std::vector<std::array<int, 10>> elements;
  std::vector<bool> inner;  // [nodes] no neighbour outside of the patch would touch it

  TetrahedronNodes at(std::size_t element, const std::vector<Vector3d>& of) const {
    TetrahedronNodes x;
    for (int a = 0; a < 10; ++a)
      x.col(a) = of[static_cast<std::size_t>(elements[element][static_cast<std::size_t>(a)])];
    return x;
  }
};

// A brick of 1.2 x 0.8 x 0.3 around a node that is not in its middle: twelve tetrahedra, none like another.
Patch brick() {
  Patch p;
  for (const auto& s : corner_sign)
    p.nodes.emplace_back(0.6 * (1 + s[0]), 0.4 * (1 + s[1]), 0.15 * (1 + s[2]));
  p.nodes.emplace_back(0.5, 0.47, 0.11);
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [at, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(p.nodes.size()));
    if (is_new)
      p.nodes.push_back(
          0.5 * (p.nodes[static_cast<std::size_t>(a)] + p.nodes[static_cast<std::size_t>(b)]));
    return at->second;
  };
  const auto add = [&](int a, int b, int c) {
    const std::array<int, 4> corner{a, c, b, 8};
    std::array<int, 10> element{a, c, b, 8};
    for (std::size_t e = 0; e < 6; ++e)
      element[4 + e] = middle(corner[static_cast<std::size_t>(tetrahedron_edge[e][0])],
                              corner[static_cast<std::size_t>(tetrahedron_edge[e][1])]);
    p.elements.push_back(element);
  };
  for (const auto& f : std::vector<std::array<int, 4>>{
           {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {3, 0, 4, 7}}) {
    add(f[0], f[1], f[2]);
    add(f[0], f[2], f[3]);
  }
  p.inner.resize(p.nodes.size());
  p.inner[8] = true;
  for (const auto& [edge, node] : middles)
    p.inner[static_cast<std::size_t>(node)] = edge.second == 8;
  return p;
}

struct Answer {
  double imbalance = 0, energy = 0, volume = 0;
};

// Largest force on an inner node over the largest of an element. `linear`: by the tangent at rest.
Answer answer_of(const Patch& p, const std::function<Vector3d(const Vector3d&)>& field,
                 bool linear) {
  std::vector<Vector3d> u, force(p.nodes.size(), Vector3d::Zero());
  for (const Vector3d& x : p.nodes) u.push_back(field(x));
  Answer answer;
  double largest = 0;
  for (std::size_t e = 0; e < p.elements.size(); ++e) {
    const TetrahedronNodes x = p.at(e, p.nodes), by = p.at(e, u);
    const auto r = tetrahedron_response(x, linear ? TetrahedronNodes(TetrahedronNodes::Zero()) : by,
                                        lambda, mu);
    const Eigen::Matrix<double, 30, 1> f =
        linear ? Eigen::Matrix<double, 30, 1>(r.tangent * by.reshaped()) : r.force;
    answer.energy += linear ? 0.5 * f.dot(by.reshaped()) : r.energy;
    answer.volume += (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).dot(x.col(3) - x.col(0)) / 6;
    for (int a = 0; a < 10; ++a) {
      force[static_cast<std::size_t>(p.elements[e][static_cast<std::size_t>(a)])] +=
          f.segment<3>(3 * a);
      largest = std::max(largest, f.segment<3>(3 * a).norm());
    }
  }
  for (std::size_t n = 0; n < force.size(); ++n)
    if (p.inner[n]) answer.imbalance = std::max(answer.imbalance, force[n].norm() / largest);
  return answer;
}

TEST(Tetrahedron, APatchCarriesAConstantStrainHoweverItIsTurned) {
  Matrix3d g;
  g << 1.1e-2, 4e-3, -2e-3, 1e-3, -7e-3, 3e-3, 5e-3, -1e-3, 6e-3;
  const Patch p = brick();
  for (const double angle : {0.0, 1.1}) {
    const Matrix3d f =
        Eigen::AngleAxisd(angle, Vector3d(1, 2, -1).normalized()) * (Matrix3d::Identity() + g);
    const Answer a = answer_of(
        p, [&](const Vector3d& x) -> Vector3d { return f * x - x; }, false);
    const Matrix3d e = 0.5 * (f.transpose() * f - Matrix3d::Identity());
    EXPECT_NEAR(a.volume, 1.2 * 0.8 * 0.3, 1e-15);
    EXPECT_LT(a.imbalance, 1e-12);
    const double density = 0.5 * lambda * e.trace() * e.trace() + mu * e.squaredNorm();
    EXPECT_NEAR(a.energy / (density * a.volume), 1, 1e-12);
  }
}

// Pure bending about y with its anticlastic surface: quadratic, and in balance without body forces.
TEST(Tetrahedron, APatchBendsExactly) {
  const double nu = 0.5 * lambda / (lambda + mu), young = 2 * mu * (1 + nu);
  const Answer a = answer_of(
      brick(),
      [&](const Vector3d& x) {
        return Vector3d(x.x() * x.z(), -nu * x.y() * x.z(),
                        -0.5 * (x.x() * x.x() + nu * (x.z() * x.z() - x.y() * x.y())));
      },
      true);
  EXPECT_LT(a.imbalance, 1e-12);
  // 1/2 E z^2 over the brick, whose lower face is z = 0.
  EXPECT_NEAR(a.energy / (0.5 * young * 1.2 * 0.8 * std::pow(0.3, 3) / 3), 1, 1e-12);
}

TEST(Tetrahedron, HasSixRigidMotionsAndNoMore) {
  const Patch p = brick();
  for (std::size_t e = 0; e < p.elements.size(); ++e) {
    const auto r = tetrahedron_response(p.at(e, p.nodes), TetrahedronNodes::Zero(), lambda, mu);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 30, 30>>(r.tangent).eigenvalues();
    EXPECT_LT(std::abs(values[0]), 1e-12 * values[29]);
    EXPECT_LT(values[5], 1e-12 * values[29]);
    EXPECT_GT(values[6], 1e-6 * values[29]);
  }
}

TEST(Tetrahedron, TheTangentIsTheDerivativeOfTheForces) {
  const Patch p = brick();
  const TetrahedronNodes x = p.at(3, p.nodes);
  TetrahedronNodes u;
  for (int a = 0; a < 10; ++a)
    u.col(a) = Vector3d(std::sin(a), std::cos(3.0 * a), std::sin(2.0 * a + 1)) * 0.02;
  const auto r = tetrahedron_response(x, u, lambda, mu);
  constexpr double h = 1e-6;
  for (int k = 0; k < 30; ++k) {
    TetrahedronNodes more = u, less = u;
    more.reshaped()[k] += h;
    less.reshaped()[k] -= h;
    const auto up = tetrahedron_response(x, more, lambda, mu, false);
    const auto down = tetrahedron_response(x, less, lambda, mu, false);
    EXPECT_LT(((up.force - down.force) / (2 * h) - r.tangent.col(k)).norm(),
              1e-7 * r.tangent.norm());
    EXPECT_NEAR((up.energy - down.energy) / (2 * h), r.force[k], 1e-7 * r.force.norm());
  }
}

}  // namespace
}  // namespace pulvis::kernels
