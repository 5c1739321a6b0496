#include "systems/static_solver.hpp"

#include <algorithm>
#include <cmath>

#include "systems/solid_systems.hpp"

namespace pulvis {
namespace {

// ---- the order of an equilibrium iteration: a newcomer's first page ---------------------------
std::vector<System> evaluation(World& w, bool with_tangent) {
  std::vector<System> list{with_tangent ? make_system(w, "solid_element", solid_element)
                                        : make_system(w, "element_force", element_force),
                           make_system(w, "solid_force", solid_force)};
  if (w.has<ProbeNode>()) list.push_back(make_system(w, "probe_contact", probe_contact));
  list.push_back(make_system(w, "residual", residual));
  return list;
}

// With the solid's factors of an earlier iteration, or new ones. The contact's tangent is always new.
std::vector<System> iteration(World& w, bool new_factors) {
  std::vector<System> list = evaluation(w, new_factors);
  if (new_factors) list.push_back(make_system(w, "block_tangent", block_tangent));
  if (new_factors) list.push_back(make_system(w, "factorise", factorise));
  list.push_back(make_system(w, "newton_direction", newton_direction));
  if (w.has<ProbeNode>()) list.push_back(make_system(w, "contact_direction", contact_direction));
  return list;
}

// What an equilibrium leaves behind for the next increment.
std::vector<System> memory(World& w) {
  std::vector<System> list;
  if (w.has<ProbeNode>()) list.push_back(make_system(w, "remember_contact", remember_contact));
  if (w.has<SolidYield>())
    list.push_back(make_system(w, "remember_plasticity", remember_plasticity));
  return list;
}

// Displacements of all nodes from those of the free ones.
void expand(const SolidMesh& mesh, const double* free, double* all) {
  const auto nodes = static_cast<int>(mesh.unknown.size());
  for (int n = 0; n < nodes; ++n)
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (const auto& support : mesh.supports_of(n))
        sum += support.weight * free[3 * mesh.unknown[static_cast<std::size_t>(support.node)] + k];
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
  world.add<ProbeTangent>();
  world.add<ProbeState>();
}

StaticSolver::StaticSolver(World& world)
    : world_(world),
      iterate_(iteration(world, true), world.chunks()),
      reuse_(iteration(world, false), world.chunks()),
      look_(evaluation(world, false), world.chunks()) {
  if (auto list = memory(world); !list.empty())
    remember_ = std::make_unique<TaskGraph>(std::move(list), world.chunks());
}

StaticSolver::~StaticSolver() = default;

void StaticSolver::remember() {
  if (remember_) remember_->run();
}

void StaticSolver::linearise() { iterate_.run(); }

std::vector<double> StaticSolver::respond(std::span<const double> forces) const {
  const auto& mesh = world_.resource<SolidMesh>();
  const auto& equations = world_.resource<SolidEquations>();
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * mesh.unknowns);
  for (std::size_t n = 0; n < mesh.unknown.size(); ++n)
    for (const auto& support : mesh.supports_of(static_cast<int>(n)))
      for (std::size_t k = 0; k < 3; ++k)
        f[3 * mesh.unknown[static_cast<std::size_t>(support.node)] + static_cast<int>(k)] +=
            support.weight * forces[3 * n + k];
  const Eigen::VectorXd u = equations.factors->solve(f);
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
  if (world_.has<Target>()) world_.resource<Target>().position[2] += share * equations.height_step;
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

// What touches first moves with the target: from there a point that slides does so in the right direction,
// while from the old one Newton's method would throw it from one side of Coulomb's law to the other.
void StaticSolver::predict(Target& target, bool reuse) {
  target.stick = true;
  (reuse ? reuse_ : iterate_).run();
  target.stick = false;
  if (std::isfinite(error())) move(1);
}

// Where a stiff tip hangs on a soft lever, round-off in its displacements leaves more than the tolerance:
// a small residual that no longer falls is as good as it gets.
bool StaticSolver::settled(const std::vector<double>& r, const NewtonSettings& settings) const {
  const double missing = std::abs(world_.resource<SolidEquations>().set_point_error);
  if (missing > settings.servo_tolerance) return false;
  const bool floor =
      r.size() > 1 && r.back() <= settings.round_off && r.back() > 0.1 * r[r.size() - 2];
  return r.back() <= settings.tolerance || floor;
}

// The full step is taken at first: the residual of a thin lever, whose membrane is a million times stiffer
// than its bending, rises far above its start and then falls quadratically. From the third iteration on
// a step must not make it grow tenfold; it is halved until it does not.
NewtonReport StaticSolver::equilibrate(const NewtonSettings& settings) {
  NewtonReport report;
  auto& u = world_.column<Displacement>();
  const std::vector<double> start(u.values(), u.values() + u.bytes() / sizeof(double));
  Target* const target = world_.has<Target>() ? &world_.resource<Target>() : nullptr;
  const double height = target != nullptr ? target->position[2] : 0;
  bool reuse = settings.reuse_factors && world_.resource<SolidEquations>().factors != nullptr;
  if (target != nullptr && target->friction > 0) predict(*target, reuse);
  for (int i = 0; i <= settings.iterations; ++i) {
    (reuse ? reuse_ : iterate_).run();
    report.residuals.push_back(error());
    // Factors that do not gain a digit an iteration are too old, until round-off is reached.
    const bool good = error() <= settings.round_off ||
                      (i > 0 && error() < 0.1 * report.residuals[report.residuals.size() - 2]);
    if (i > 0) reuse = settings.reuse_factors && good;
    if (!std::isfinite(report.residuals.back())) break;
    report.converged = settled(report.residuals, settings);
    if (report.converged) return report;
    move(1);
    if (i >= 2) search(10 * report.residuals.back(), settings.cuts);
  }
  std::copy(start.begin(), start.end(), u.values());
  if (target != nullptr) target->position[2] = height;
  return report;
}

}  // namespace pulvis
