// contact_direction: brings the contact's stiffness, and the servo's equation, into Newton's direction.
//
// Source   The solid's tangent K is symmetric and positive definite, so it is factorised as L D L^T
//          whatever the contact does. Contact adds C, 3 x 3 at each touching point, unsymmetric where it
//          slides; the few equations it couples are solved densely (Woodbury):
//            (K + B C B^T)^-1 r = y - Y (1 + C B^T Y)^-1 C B^T y,   y = K^-1 r,  Y = K^-1 B
//          Servo: the target's height Z is one more unknown. With w the answer to C e_z at the points,
//            du = d + dZ w,  force missing g:  dZ = (g + sum e_z.C d) / (sum e_z.C (e_z - w))
// Symbols  B [3 unknowns, 3 points] where the points' places come from; d = the direction at fixed height
// Runs     after newton_direction, whose answer is y
// Active   when the scene has a surface
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "systems/solid_systems.hpp"

namespace pulvis {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What the touching points add to the equations.
struct Coupling {
  MatrixXd b;   // [3 unknowns, 3 points]
  MatrixXd c;   // [3 points, 3 points], N/m
  VectorXd up;  // [3 points] e_z of each

  Coupling(const SolidMesh& mesh, const Read<ProbeNode>& node, const Read<ProbeTangent>& tangent,
           const std::vector<int>& points) {
    const auto size = 3 * static_cast<Eigen::Index>(points.size());
    b.setZero(3 * mesh.unknowns, size);
    c.setZero(size, size);
    up.setZero(size);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Row<ProbePoint> row(points[p]);
      const auto at = 3 * static_cast<Eigen::Index>(p);
      for (const auto& support : mesh.supports_of(node(row)))
        for (int k = 0; k < 3; ++k)
          b(3 * mesh.unknown[static_cast<std::size_t>(support.node)] + k, at + k) += support.weight;
      for (int k = 0; k < 9; ++k) c(at + k / 3, at + k % 3) = tangent(row, k);
      up[at + 2] = 1;
    }
  }
};

std::vector<int> touching(const Read<ProbeTangent>& tangent) {
  std::vector<int> points;
  for (int i = 0; i < tangent.rows(); ++i) {
    double largest = 0;
    for (int k = 0; k < 9; ++k)
      largest = std::max(largest, std::abs(tangent(Row<ProbePoint>(i), k)));
    if (largest > 0) points.push_back(i);
  }
  return points;
}

// By the smallest gap, and on until the penalty pushes with what is missing.
void follow_probe(const Read<ProbeState>& state, const Read<ProbeStiffness>& stiffness,
                  const Target& target, SolidEquations& equations) {
  double gap = state(Row<ProbePoint>(0), 0);
  for (int i = 1; i < state.rows(); ++i) gap = std::min(gap, state(Row<ProbePoint>(i), 0));
  equations.height_step = gap + std::abs(target.set_point) / stiffness(Row<ProbePoint>(0), 0);
}

}  // namespace

void contact_direction(Read<SolidMesh> mesh, Read<Target> target, Read<ProbeNode> node,
                       Read<ProbeTangent> tangent, Read<ProbeState> state,
                       Read<ProbeStiffness> stiffness, Write<SolidEquations> equations) {
  equations->height_step = 0;
  const std::vector<int> points = touching(tangent);
  if (points.empty()) {
    // The servo has lost the probe: the target follows it.
    if (target->servo) follow_probe(state, stiffness, *target, *equations);
    return;
  }
  const Coupling coupling(*mesh, node, tangent, points);
  const MatrixXd y = equations->factors->solve(coupling.b);
  const MatrixXd by = coupling.b.transpose() * y;
  const Eigen::PartialPivLU<MatrixXd> small(MatrixXd::Identity(by.rows(), by.cols()) +
                                            coupling.c * by);
  VectorXd& d = equations->direction;
  d -= y * small.solve(coupling.c * (coupling.b.transpose() * d));
  if (!target->servo) return;

  // w = (K + B C B^T)^-1 B C e_z, from the same small system.
  const VectorXd load = coupling.c * coupling.up;
  const VectorXd w = y * (load - small.solve(coupling.c * (by * load)));
  const VectorXd sensed = coupling.c.transpose() * coupling.up;
  const double missing = equations->set_point_error * std::abs(target->set_point);
  const double at_fixed_height = sensed.dot(coupling.b.transpose() * d);
  const double by_height = sensed.dot(coupling.up - coupling.b.transpose() * w);
  equations->height_step = (missing + at_fixed_height) / by_height;
  d += equations->height_step * w;
}

}  // namespace pulvis
