#include "systems/lever/static_solver.hpp"

#include <algorithm>
#include <cmath>

#include "engine/interruption.hpp"
#include "systems/lever/solid_systems.hpp"

namespace pulvis {
namespace {

// ---- the order of an equilibrium iteration: start reading here --------------------------------
std::vector<System> evaluation(World& w, bool with_tangent) {
  std::vector<System> list{with_tangent ? make_system<solid_element>(w, "solid_element")
                                        : make_system<element_force>(w, "element_force")};
  if (w.has<TetrahedronForce>())
    list.push_back(with_tangent ? make_system<solid_tetrahedron>(w, "solid_tetrahedron")
                                : make_system<tetrahedron_force>(w, "tetrahedron_force"));
  list.push_back(make_system<solid_force>(w, "solid_force"));
  if (w.has<ProbeNode>()) list.push_back(make_system<probe_contact>(w, "probe_contact"));
  list.push_back(make_system<residual>(w, "residual"));
  return list;
}

std::vector<System> linearisation(World& w) {
  if (w.resource<SolidEquations>().in_extended) {
    std::vector<System> list = evaluation(w, false);
    list.push_back(make_system<factorise_extended>(w, "factorise_extended"));
    return list;
  }
  std::vector<System> list = evaluation(w, true);
  list.push_back(make_system<block_tangent>(w, "block_tangent"));
  list.push_back(make_system<factorise>(w, "factorise"));
  return list;
}

// With the solid's factors from an earlier iteration, or new ones. The contact is always solved anew.
std::vector<System> iteration(World& w, bool new_factors) {
  std::vector<System> list = new_factors ? linearisation(w) : evaluation(w, false);
  list.push_back(make_system<newton_direction>(w, "newton_direction"));
  if (w.has<ProbeNode>()) list.push_back(make_system<contact_direction>(w, "contact_direction"));
  return list;
}

// What an equilibrium carries over to the next increment.
std::vector<System> memory(World& w) {
  std::vector<System> list;
  if (w.has<ProbeNode>()) list.push_back(make_system<commit_contact>(w, "commit_contact"));
  if (w.has<SolidYield>()) list.push_back(make_system<commit_plasticity>(w, "commit_plasticity"));
  return list;
}

// Displacements of all nodes from those of the free ones.
void expand(const SolidMesh& mesh, const double* free, double* all) {
  const auto nodes = static_cast<int>(mesh.unknown.size());
  for (int n = 0; n < nodes; ++n)
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (const auto& support : mesh.supports_of(n))
        sum += support.weight * free[mesh.first_equation(support.node) + k];
      all[3 * n + k] = sum;
    }
}

}  // namespace

void add_solid_columns(World& world) {
  world.add<Displacement>();
  world.add<AppliedForce>();
  world.add<SolidForce>();
  world.add<ElementForce>();
  world.add<ElementTangent>();
  world.add<ElementEnergy>();
  world.add<BlockTangent>();
  world.emplace<SolidEquations>();
}

void add_tetrahedron_columns(World& world) {
  world.add<TetrahedronLame>();
  world.add<TetrahedronForce>();
  world.add<TetrahedronTangent>();
  world.add<TetrahedronEnergy>();
}

void add_plastic_columns(World& world) {
  world.add<SolidYield>();
  world.add<SolidMemory>();
}

void add_probe_columns(World& world, std::size_t points) {
  world.add_table<ProbePoint>(points);
  world.add<ProbeNode>();
  world.add<ProbeStiffness>();
  world.add<ProbeShare>();
  world.add<ProbeMemory>();
  world.add<ProbeForce>();
  world.add<ProbeState>();
}

StaticSolver::StaticSolver(World& world)
    : world_(world),
      reuse_(iteration(world, false), world.chunks()),
      look_(evaluation(world, false), world.chunks()) {
  make_graphs();
  if (auto list = memory(world); !list.empty())
    commit_ = std::make_unique<TaskGraph>(std::move(list), world.chunks());
}

StaticSolver::~StaticSolver() = default;

void StaticSolver::make_graphs() {
  linearise_ = std::make_unique<TaskGraph>(linearisation(world_), world_.chunks());
  iterate_ = std::make_unique<TaskGraph>(iteration(world_, true), world_.chunks());
}

void StaticSolver::commit() {
  if (commit_) commit_->run();
}

void StaticSolver::linearise() { linearise_->run(); }

void StaticSolver::extend_precision() {
  auto& equations = world_.resource<SolidEquations>();
  equations.in_extended = true;
  equations.plain = {};
  make_graphs();
}

bool StaticSolver::in_extended_precision() const {
  return world_.resource<SolidEquations>().in_extended;
}

bool StaticSolver::stable() const { return world_.resource<SolidEquations>().positive(); }

std::vector<double> StaticSolver::respond(std::span<const double> forces) const {
  const auto& mesh = world_.resource<SolidMesh>();
  const auto& equations = world_.resource<SolidEquations>();
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * mesh.unknowns);
  for (int n = 0; n < static_cast<int>(mesh.unknown.size()); ++n)
    for (const auto& support : mesh.supports_of(n))
      for (int k = 0; k < 3; ++k)
        f[mesh.first_equation(support.node) + k] += support.weight * entry(forces, 3 * n + k);
  const Eigen::VectorXd u = equations.solve(f);
  std::vector<double> all(forces.size());
  expand(mesh, u.data(), all.data());
  return all;
}

void StaticSolver::move(double share) {
  const auto& mesh = world_.resource<SolidMesh>();
  const auto& equations = world_.resource<SolidEquations>();
  std::vector<double> step(3 * mesh.unknown.size());
  expand(mesh, equations.direction.data(), step.data());
  double* u = world_.column<Displacement>().values();
  for (std::size_t i = 0; i < step.size(); ++i) u[i] += share * step[i];
  if (!world_.has<Target>()) return;
  world_.resource<Target>().travel[2] += share * equations.height_step;
  double* force = world_.column<ProbeForce>().values();
  for (Eigen::Index i = 0; i < equations.force_step.size(); ++i)
    force[i] += share * equations.force_step[i];
}

void StaticSolver::search(double allowed, int cuts) {
  double share = 1;
  for (int i = 0; i < cuts; ++i) {
    look_.run();
    if (error() <= allowed) return;
    share *= 0.5;
    move(-share);
  }
}

double StaticSolver::error() const {
  const auto& equations = world_.resource<SolidEquations>();
  const double size = equations.residual.norm();
  return size == 0 ? 0 : size / equations.scale;
}

// Where a stiff tip hangs on a soft lever, round-off in its displacements leaves more than the tolerance: a residual
// that no longer falls is as good as it gets, provided Newton's method itself would hardly move on. (For a lever
// 10,000 times longer than thick, the last digit of its displacements is worth more than its load.) The contact law
// is satisfied if its forces fit the positions, or if both have stopped changing: the positions of a ball a
// thousand times stiffer than its lever are accurate to 1e-13 of its displacement, which is 1e-5 of its forces.
bool StaticSolver::settled(const std::vector<double>& r, const NewtonSettings& settings) const {
  const auto& equations = world_.resource<SolidEquations>();
  const bool stays = r.size() > 1 && r.back() > 0.1 * r[r.size() - 2];
  const bool small = r.back() <= settings.round_off && step_size() <= settings.step;
  const bool floor =
      stays && (small || (equations.in_extended && step_size() <= settings.last_digits));
  const double contact =
      floor ? std::min(equations.contact_error, equations.contact_change) : equations.contact_error;
  if (std::max(std::abs(equations.set_point_error), contact) > settings.contact_tolerance)
    return false;
  return r.back() <= settings.tolerance || floor;
}

// Of the Newton step, over the displacements or the scanner's displacement.
double StaticSolver::step_size() const {
  const auto& u = world_.column<Displacement>();
  double largest = 0;
  for (std::size_t i = 0; i < u.bytes() / sizeof(double); ++i)
    largest = std::max(largest, std::abs(u.values()[i]));
  if (world_.has<Target>())
    for (const double displacement : world_.resource<Target>().travel)
      largest = std::max(largest, std::abs(displacement));
  const double step = world_.resource<SolidEquations>().direction.lpNorm<Eigen::Infinity>();
  return step == 0 ? 0 : step / std::max(step, largest);
}

// The full step is taken at first: the residual of a thin lever, whose membrane is a million times stiffer
// than its bending, rises far above its initial value and then falls quadratically. From the third iteration
// on a step must not increase it tenfold; it is halved until it does not.
NewtonReport StaticSolver::equilibrate(const NewtonSettings& settings) {
  NewtonReport report;
  const auto& equations = world_.resource<SolidEquations>();
  const State start = state();
  if (world_.has<Target>()) world_.resource<Target>().may_jump = settings.may_jump;
  world_.resource<SolidEquations>().jumped = false;
  auto& memory = world_.resource<SolidEquations>();
  const bool may_reuse = settings.reuse_factors;
  bool reuse = may_reuse && equations.has_factors() && memory.fresh_increments == 0;
  bool old_at_first = reuse;
  if (memory.fresh_increments > 0) --memory.fresh_increments;
  for (int i = 0; i <= settings.iterations; ++i) {
    stop_if_asked();
    (reuse ? reuse_ : *iterate_).run();
    report.residuals.push_back(error());
    // Factors that do not gain a digit per iteration are too old, until round-off is reached.
    // (The first iteration started from balance: the residual left by the new contact forces is no measure.)
    const bool good = error() <= settings.round_off || i == 1 ||
                      (i > 0 && error() < 0.1 * report.residuals[report.residuals.size() - 2]);
    // A very stiff tip that has rotated by a thousandth of a radian is too different for the old factors:
    // their result is too far off to continue from.
    if (i == 2 && old_at_first && reuse && !(error() < 0.5 * report.residuals[1] || good)) {
      restore(start);
      report = {};
      world_.resource<SolidEquations>().jumped = false;
      memory.rest_from_old_factors();
      old_at_first = reuse = false;
      i = -1;
      continue;
    }
    if (i > 0) reuse = may_reuse && good;
    if (!std::isfinite(report.residuals.back())) break;
    report.converged = settled(report.residuals, settings);
    if (report.converged) {
      if (old_at_first) memory.fresh_after_failure = 1;
      return report;
    }
    if (!equations.contact_solved) break;
    report.released += equations.released;
    move(1);
    if (i >= 2) search(10 * report.residuals.back(), settings.cuts);
  }
  restore(start);
  return report;
}

StaticSolver::State StaticSolver::state() const {
  State state;
  const auto& u = world_.column<Displacement>();
  state.displacement.assign(u.values(), u.values() + u.bytes() / sizeof(double));
  if (!world_.has<Target>()) return state;
  const auto& force = world_.column<ProbeForce>();
  state.force.assign(force.values(), force.values() + 3 * force.table.rows);
  state.height = world_.resource<Target>().travel[2];
  return state;
}

void StaticSolver::restore(const State& state) {
  std::ranges::copy(state.displacement, world_.column<Displacement>().values());
  if (!world_.has<Target>()) return;
  std::ranges::copy(state.force, world_.column<ProbeForce>().values());
  world_.resource<Target>().travel[2] = state.height;
}

}  // namespace pulvis
