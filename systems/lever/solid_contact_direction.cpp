// contact_direction: solves the contact, its non-smooth points included, with the solid as it answers to first order,
// and brings what its forces change into Newton's direction.
//
// Source   The solid's tangent K is symmetric and positive definite, so it is factorised as L D L^T
//          whatever the contact does. With y = K^-1 r the direction at unchanged forces f_0 of the probe,
//            du = y + K^-1 B (f - f_0),   x = x_0 + B^T y + S (f - f_0) - Z e_z,   S = B^T K^-1 B
//          and f, Z fulfil the law of contact and the servo's equation (solid_contact_problem.hpp). Stick
//          and slip are settled there, where an iteration costs nothing; the iterations of the solid see
//          its own smooth answer only.
// Symbols  B [3 unknowns, 3 points] where the points' places come from
// Runs     after newton_direction, whose answer is y
// Active   when the scene has a surface
#include <algorithm>
#include <numeric>

#include "engine/interruption.hpp"
#include "systems/lever/solid_contact_problem.hpp"
#include "systems/lever/solid_systems.hpp"

namespace pulvis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int max_rounds = 20;

struct Contact {
  const SolidMesh& mesh;
  const Read<ProbeNode>& node;
  SolidEquations& equations;

  auto supports(int p) const { return mesh.supports_of(node(Row<ProbePoint>(p))); }

  // B_p^T of a direction: how the point moves.
  Vector3d moved(int p, const VectorXd& direction) const {
    Vector3d sum = Vector3d::Zero();
    for (const auto& s : supports(p))
      sum += s.weight * direction.segment<3>(3 * mesh.unknown[static_cast<std::size_t>(s.node)]);
    return sum;
  }

  // K^-1 B_p, asked of the factors once.
  const MatrixXd& answer(int p) const {
    auto& answers = equations.answers;
    answers.resize(static_cast<std::size_t>(node.rows()));
    MatrixXd& mine = answers[static_cast<std::size_t>(p)];
    if (mine.size() > 0) return mine;
    stop_if_asked();
    MatrixXd unit = MatrixXd::Zero(3 * mesh.unknowns, 3);
    for (const auto& s : supports(p))
      for (int k = 0; k < 3; ++k)
        unit(3 * mesh.unknown[static_cast<std::size_t>(s.node)] + k, k) += s.weight;
    mine = equations.solve(unit);
    return mine;
  }

  MatrixXd compliance(const std::vector<int>& points) const {
    const auto size = 3 * static_cast<Index>(points.size());
    MatrixXd s(size, size);
    for (std::size_t b = 0; b < points.size(); ++b)
      for (int k = 0; k < 3; ++k) {
        const VectorXd column = answer(points[b]).col(k);
        for (std::size_t a = 0; a < points.size(); ++a)
          s.block<3, 1>(3 * static_cast<Index>(a), 3 * static_cast<Index>(b) + k) =
              moved(points[a], column);
      }
    return s;
  }
};

// Those that carry a force, touch or are drawn, and the nearest one.
std::vector<int> first_points(const Read<ProbeForce>& force, const Read<ProbeState>& state,
                              const Read<ProbeShare>& share, const Target& target) {
  std::vector<int> points;
  int nearest = 0;
  for (int i = 0; i < state.rows(); ++i)
    if (state(Row<ProbePoint>(i), 0) < state(Row<ProbePoint>(nearest), 0)) nearest = i;
  for (int i = 0; i < state.rows(); ++i) {
    const Row<ProbePoint> row(i);
    const bool pushed = force(row, 0) != 0 || force(row, 1) != 0 || force(row, 2) != 0;
    const bool drawn = target.pull_off * share(row) > 0;
    if (pushed || drawn || state(row, 0) <= 0 || i == nearest) points.push_back(i);
  }
  return points;
}

}  // namespace

void contact_direction(Read<SolidMesh> mesh, Read<Target> target, Read<ReferencePosition> reference,
                       Read<Displacement> displacement, Read<ProbeNode> node,
                       Read<ProbeStiffness> stiffness, Read<ProbeShare> share,
                       Read<ProbeMemory> memory, Read<ProbeForce> force, Read<ProbeState> state,
                       Write<SolidEquations> equations) {
  const Contact contact{*mesh, node, *equations};
  const VectorXd free = equations->direction;
  std::vector<int> points = first_points(force, state, share, *target);
  const auto place = [&](int p, const VectorXd& direction) -> Vector3d {
    return probe_place(Row<ProbePoint>(p), reference, displacement, *target, node) +
           contact.moved(p, direction);
  };
  equations->contact_change = 1;
  for (int round = 0; round < max_rounds; ++round) {
    ContactProblem problem{target->shape.get(), target->end_radius, {}, {}, {}, target->may_jump};
    if (target->servo) problem.set_point = target->set_point;
    for (const int p : points) {
      const Row<ProbePoint> row(p);
      problem.points.push_back(
          contact_point(row, place(p, free), *target, stiffness, share, memory, force));
      // What has snapped off in an earlier iteration is not held by the adhesion of contact any more.
      if (equations->jumped && state(row, 3) == 0) problem.points.back().touched = false;
    }
    problem.compliance = contact.compliance(points);
    const ContactAnswer answer = solve_contact(problem);
    equations->contact_solved = answer.converged;
    equations->released = answer.released;
    equations->jumped = equations->jumped || answer.released > 0;
    if (!answer.converged) return;
    equations->height_step = answer.height;
    equations->force_step.setZero(3 * node.rows());
    equations->direction = free;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3d change =
          answer.force.segment<3>(3 * static_cast<Index>(i)) - problem.points[i].force;
      equations->force_step.segment<3>(3 * points[i]) = change;
      equations->direction += contact.answer(points[i]) * change;
    }
    const double most = equations->force_step.lpNorm<Eigen::Infinity>();
    double moved = 0, travel = Vector3d(target->travel.data()).norm();
    for (const int p : points) {
      const Vector3d step =
          contact.moved(p, equations->direction) - answer.height * Vector3d::UnitZ();
      moved = std::max(moved, step.norm());
    }
    // A probe that slides steadily moves on under forces that stay.
    equations->contact_change =
        std::max(most == 0 ? 0 : most / std::max(most, equations->largest_force),
                 moved == 0 ? 0 : moved / std::max(moved, travel));
    // Points that come to touch by that are asked as well.
    std::vector<int> more;
    for (int p = 0; p < node.rows(); ++p) {
      if (std::ranges::binary_search(points, p)) continue;
      Vector3d x = place(p, equations->direction) - answer.height * Vector3d::UnitZ();
      const auto nearest = target->shape->nearest({x.x(), x.y(), x.z() + target->end_radius});
      if (nearest.distance - target->end_radius <= 0) more.push_back(p);
    }
    if (more.empty()) return;
    points.insert(points.end(), more.begin(), more.end());
    std::ranges::sort(points);
  }
}

}  // namespace pulvis
