#include "systems/static_solver.hpp"

#include <cmath>

#include "systems/solid_systems.hpp"

namespace pulvis {
namespace {

// ---- the order of an equilibrium iteration: a newcomer's first page ---------------------------
std::vector<System> evaluation(World& w) {
  return {make_system(w, "solid_element", solid_element), make_system(w, "solid_force", solid_force),
          make_system(w, "residual", residual)};
}

std::vector<System> iteration(World& w) {
  std::vector<System> list = evaluation(w);
  list.push_back(make_system(w, "block_tangent", block_tangent));
  list.push_back(make_system(w, "factorise", factorise));
  list.push_back(make_system(w, "newton_direction", newton_direction));
  return list;
}

// Displacements of all nodes from those of the free ones.
void expand(const SolidMesh& mesh, const double* free, double* all) {
  const auto nodes = static_cast<int>(mesh.unknown.size());
  for (int n = 0; n < nodes; ++n)
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (const auto& support : mesh.supports_of(n))
        sum += support.weight *
               free[3 * mesh.unknown[static_cast<std::size_t>(support.node)] + k];
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

StaticSolver::StaticSolver(World& world)
    : world_(world),
      iterate_(iteration(world), world.chunks()),
      look_(evaluation(world), world.chunks()) {}

StaticSolver::~StaticSolver() = default;

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

std::vector<double> StaticSolver::held_forces(std::span<const double> displacements) const {
  const auto& mesh = world_.resource<SolidMesh>();
  const double* tangent = world_.column<ElementTangent>().values();
  std::vector<double> forces(displacements.size());
  for (std::size_t e = 0; e < mesh.hexahedra.size(); ++e) {
    const double* k = tangent + ElementTangent::count * e;
    const auto at = [&](int i) {
      return static_cast<std::size_t>(3 * mesh.hexahedra[e][static_cast<std::size_t>(i / 3)] +
                                      i % 3);
    };
    for (int i = 0; i < 24; ++i)
      for (int j = 0; j <= i; ++j, ++k) {
        forces[at(i)] += *k * displacements[at(j)];
        if (i != j) forces[at(j)] += *k * displacements[at(i)];
      }
  }
  return forces;
}

void StaticSolver::move(double share) {
  const auto& mesh = world_.resource<SolidMesh>();
  const auto& equations = world_.resource<SolidEquations>();
  std::vector<double> step(3 * mesh.unknown.size());
  expand(mesh, equations.direction.data(), step.data());
  double* u = world_.column<Displacement>().values();
  for (std::size_t i = 0; i < step.size(); ++i) u[i] += share * step[i];
}

double StaticSolver::error() const {
  const auto& equations = world_.resource<SolidEquations>();
  const double size = equations.residual.norm();
  return size == 0 ? 0 : size / equations.scale;
}

// The line search halves a step that would not lessen the residual: far from equilibrium the residual
// of a thin lever, whose membrane is a million times stiffer than its bending, first rises and then
// falls quadratically, so a rise is let pass while the step is small against the solid's own size.
NewtonReport StaticSolver::equilibrate(const NewtonSettings& settings) {
  NewtonReport report;
  auto& u = world_.column<Displacement>();
  const std::vector<double> start(u.values(), u.values() + u.bytes() / sizeof(double));
  for (int i = 0; i <= settings.iterations; ++i) {
    iterate_.run();
    report.residuals.push_back(error());
    if (!std::isfinite(report.residuals.back())) break;
    report.converged = report.residuals.back() <= settings.tolerance;
    if (report.converged) return report;
    move(1);
  }
  std::copy(start.begin(), start.end(), u.values());
  return report;
}

}  // namespace pulvis
