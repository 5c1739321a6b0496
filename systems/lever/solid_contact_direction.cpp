// contact_direction: solves the contact, including its non-smooth points, with the linearised response of the solid,
// and adds the effect of its forces to the Newton direction.
//
// Source   The solid's tangent K is symmetric and positive definite, so it is factorised as L D L^T
//          whatever the contact state. With y = K^-1 r the direction at unchanged forces f_0 of the probe,
//            du = y + K^-1 B (f - f_0),   x = x_0 + B^T y + S (f - f_0) - Z e_z,   S = B^T K^-1 B
//          and f, Z satisfy the contact law and the servo equation (solid_contact_problem.hpp). Stick
//          and slip are resolved there, where an iteration costs nothing; the iterations of the solid see
//          only its own smooth response.
// Symbols  B [3 unknowns, 3 points] its transpose gives the displacements of the points
// Runs     after newton_direction, whose result is y
// Active   when the scene has a surface
#include <algorithm>

#include "engine/entry.hpp"
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

// The active points of the probe, on a solid that responds to their forces.
class ProbeContact {
 public:
  explicit ProbeContact(const contact_direction& system)
      : mesh_(*system.mesh),
        configuration_(system.configuration),
        target_(*system.target),
        probe_(system.probe),
        state_(system.state),
        equations_(*system.equations),
        free_(equations_.direction),
        points_(first_points()) {}

  // The contact law at the points, starting from their positions at unchanged forces.
  ContactProblem problem() const {
    ContactProblem problem{target_.shape.get(), target_.end_radius, {}, {}, {}, target_.may_jump};
    if (target_.servo) problem.set_point = target_.set_point;
    for (const int p : points_) {
      const Row<ProbePoint> row(p);
      problem.points.push_back(contact_point(row, place(p, free_), target_, probe_));
      // Points that snapped off in an earlier iteration are no longer held by contact adhesion.
      if (equations_.jumped && state_(row, 3) == 0) problem.points.back().touched = false;
    }
    find_responses();
    problem.compliance = compliance();
    return problem;
  }

  // The increments of the forces, the target's height and the solid.
  void take(const ContactAnswer& answer, const ContactProblem& problem) {
    equations_.height_step = answer.height;
    equations_.force_step.setZero(3 * probe_.node.rows());
    equations_.direction = free_;
    for (Index i = 0; i < count(); ++i) {
      const int p = entry(points_, i);
      const Vector3d change = answer.force.segment<3>(3 * i) - entry(problem.points, i).force;
      equations_.force_step.segment<3>(3 * p) = change;
      equations_.direction += response(p) * change;
    }
    equations_.contact_change = change();
  }

  // Activates points that this brings into contact. False: there are none.
  bool ask_more() {
    std::vector<int> more;
    for (int p = 0; p < probe_.node.rows(); ++p)
      if (!std::ranges::binary_search(points_, p) && comes_to_touch(p)) more.push_back(p);
    points_.insert(points_.end(), more.begin(), more.end());
    std::ranges::sort(points_);
    return !more.empty();
  }

 private:
  Index count() const { return static_cast<Index>(points_.size()); }
  int node(int p) const { return probe_.node(Row<ProbePoint>(p)); }

  // Those that carry a force, touch or are attracted, and the nearest one.
  std::vector<int> first_points() const {
    std::vector<int> points;
    int nearest = 0;
    for (int i = 0; i < state_.rows(); ++i)
      if (state_(Row<ProbePoint>(i), 0) < state_(Row<ProbePoint>(nearest), 0)) nearest = i;
    const auto& force = probe_.force;
    for (int i = 0; i < state_.rows(); ++i) {
      const Row<ProbePoint> row(i);
      const bool pushed = force(row, 0) != 0 || force(row, 1) != 0 || force(row, 2) != 0;
      const bool drawn = target_.pull_off * probe_.share(row) > 0;
      if (pushed || drawn || state_(row, 0) <= 0 || i == nearest) points.push_back(i);
    }
    return points;
  }

  // B_p^T times a direction: motion of the point.
  Vector3d moved(int p, const VectorXd& direction) const {
    Vector3d sum = Vector3d::Zero();
    for (const auto& s : mesh_.supports_of(node(p)))
      sum += s.weight * direction.segment<3>(mesh_.first_equation(s.node));
    return sum;
  }

  Vector3d place(int p, const VectorXd& direction) const {
    return probe_place(node(p), configuration_, target_) + moved(p, direction);
  }

  // K^-1 B_p, computed once: by find_responses.
  const MatrixXd& response(int p) const { return entry(equations_.answers, p); }

  void find_responses() const {
    equations_.answers.resize(static_cast<std::size_t>(probe_.node.rows()));
    std::vector<int> unknown;
    for (const int p : points_)
      if (response(p).size() == 0) unknown.push_back(p);
    // Together they take less time, but not too much memory.
    constexpr std::size_t most = 16;
    for (std::size_t first = 0; first < unknown.size(); first += most)
      find_responses(std::span(unknown).subspan(first, std::min(most, unknown.size() - first)));
  }

  void find_responses(std::span<const int> points) const {
    stop_if_asked();
    MatrixXd unit = MatrixXd::Zero(3 * mesh_.unknowns, 3 * std::ssize(points));
    for (Index i = 0; i < std::ssize(points); ++i)
      for (const auto& s : mesh_.supports_of(node(entry(points, i))))
        for (int k = 0; k < 3; ++k) unit(mesh_.first_equation(s.node) + k, 3 * i + k) += s.weight;
    const MatrixXd answers = equations_.solve(unit);
    for (Index i = 0; i < std::ssize(points); ++i)
      entry(equations_.answers, entry(points, i)) = answers.middleCols<3>(3 * i);
  }

  MatrixXd compliance() const {
    MatrixXd s(3 * count(), 3 * count());
    for (Index b = 0; b < count(); ++b)
      for (int k = 0; k < 3; ++k) {
        const VectorXd column = response(entry(points_, b)).col(k);
        for (Index a = 0; a < count(); ++a)
          s.block<3, 1>(3 * a, 3 * b + k) = moved(entry(points_, a), column);
      }
    return s;
  }

  // Remaining change of forces, over the largest, or of positions, over the scanner's displacement.
  double change() const {
    const double maximum = equations_.force_step.lpNorm<Eigen::Infinity>();
    double moved_by = 0, travel = Vector3d(target_.travel.data()).norm();
    for (const int p : points_) {
      const Vector3d step =
          moved(p, equations_.direction) - equations_.height_step * Vector3d::UnitZ();
      moved_by = std::max(moved_by, step.norm());
    }
    // A probe that slides steadily keeps moving under constant forces.
    return std::max(maximum == 0 ? 0 : maximum / std::max(maximum, equations_.largest_force),
                    moved_by == 0 ? 0 : moved_by / std::max(moved_by, travel));
  }

  bool comes_to_touch(int p) const {
    const Vector3d x = place(p, equations_.direction) - equations_.height_step * Vector3d::UnitZ();
    const auto nearest = target_.shape->nearest({x.x(), x.y(), x.z() + target_.end_radius});
    return nearest.distance - target_.end_radius <= 0;
  }

  const SolidMesh& mesh_;
  const Configuration& configuration_;
  const Target& target_;
  const Probe& probe_;
  const Read<ProbeState>& state_;
  SolidEquations& equations_;
  VectorXd free_;            // m, the direction at unchanged forces
  std::vector<int> points_;  // in ascending order
};

}  // namespace

void contact_direction::operator()() const {
  ProbeContact contact(*this);
  equations->contact_change = 1;
  for (int round = 0; round < max_rounds; ++round) {
    const ContactProblem problem = contact.problem();
    const ContactAnswer answer = solve_contact(problem);
    equations->contact_solved = answer.converged;
    equations->released = answer.released;
    equations->jumped = equations->jumped || answer.released > 0;
    if (!answer.converged) return;
    contact.take(answer, problem);
    if (!contact.ask_more()) return;
  }
}

}  // namespace pulvis
