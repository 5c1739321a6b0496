// residual, factorise, newton_direction: the equations of an equilibrium iteration.
//
// Source   K du = r with the lower triangle of K by columns; L D L^T by supernodes (systems/sparse) in the order of
//          Eigen's approximate minimum degree, computed once: the pattern never changes.
// Runs     after solid_force (residual) and block_tangent (factorise, then newton_direction)
// Active   when the scene has a lever
#include "systems/lever/solid_equations.hpp"

#include <fmt/format.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/interruption.hpp"
#include "engine/run_failure.hpp"
#include "engine/state_bytes.hpp"
#include "systems/lever/solid_systems.hpp"

namespace pulvis {
namespace {

sparse::BlockGraph graph_of(const SolidAssembly& assembly) {
  return {assembly.column_begin, assembly.block_row};
}

// With little fill: approximate minimum degree (P. R. Amestoy, T. A. Davis & I. S. Duff, SIAM Journal on Matrix Analysis and
// Applications 17 (1996) 886).
std::vector<std::int32_t> elimination_order(const sparse::BlockGraph& graph) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < graph.columns(); ++c)
    for (const int r : graph.rows_of(c)) entries.emplace_back(r, c, 1);
  Eigen::SparseMatrix<double> pattern(graph.columns(), graph.columns());
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  std::vector<std::int32_t> position(static_cast<std::size_t>(graph.columns()));
  for (int i = 0; i < graph.columns(); ++i) entry(position, order.indices()[i]) = i;
  return position;
}

// Blocks of a column are in ascending order of rows, the diagonal one first: so are its values.
template <class Real>
std::vector<Real> values_of(const SolidAssembly& assembly, std::span<const Real> blocks) {
  std::vector<Real> values;
  const Real* column = blocks.data();  // [blocks of the column, 3, 3]
  for (int c = 0; c < assembly.columns(); ++c) {
    const auto rows = assembly.rows_of(c);
    for (int j = 0; j < 3; ++j) {
      const Real* block = column;
      for (const int r : rows) {
        for (int i = r == c ? j : 0; i < 3; ++i) values.push_back(block[3 * i + j]);
        block += 9;
      }
    }
    column += 9 * rows.size();
  }
  return values;
}

// For a large solid this takes a minute. If interrupted, the solid is left without factors.
template <class Real>
bool factorise_stiffness(SolidFactors<Real>& solid) {
  bool succeeded = false;
  std::tie(solid.stiffness, solid.factors, succeeded) = interruptible(
      [stiffness = std::move(solid.stiffness), factors = std::move(solid.factors)]() mutable {
        const bool found = factors->factorise(stiffness);
        return std::tuple(std::move(stiffness), std::move(factors), found);
      });
  return succeeded;
}

template <class Real>
void refactorise(SolidFactors<Real>& solid, const std::vector<double>& values) {
  constexpr std::size_t parts = std::is_same_v<Real, double> ? 1 : 2;
  const std::size_t size = solid.stiffness.size();
  if (solid.factors == nullptr || values.size() != parts * size)
    throw BadState("the stiffness of the solid does not fit its mesh");
  for (std::size_t i = 0; i < size; ++i) {
    solid.stiffness[i] = values[i];
    if (parts == 2) solid.stiffness[i] += values[size + i];
  }
  factorise_stiffness(solid);
}

// Force balance of every free node, and the magnitudes it is compared with.
struct Balance {
  const SolidMesh& mesh;
  Eigen::VectorXd& sum;
  double squares = 0;  // N^2, of all forces that must balance
  // On the probe:
  double pushed = 0;   // N, upwards
  double largest = 0;  // N, in any direction
  double broken = 0;   // N, largest violation of the contact law by the forces

  void add(int node, int k, double force) {
    for (const auto& support : mesh.supports_of(node))
      sum[mesh.first_equation(support.node) + k] += support.weight * force;
  }

  void add_loads(const Read<AppliedForce>& applied, const Read<SolidForce>& stresses) {
    for (int n = 0; n < stresses.rows(); ++n)
      for (int k = 0; k < 3; ++k) {
        const Row<SolidNode> row(n);
        add(n, k, applied(row, k) - stresses(row, k));
        squares += applied(row, k) * applied(row, k);
      }
  }

  void add_contact(const residual::Contact& contact) {
    for (int i = 0; i < contact.force.rows(); ++i)
      for (int k = 0; k < 3; ++k) {
        const Row<ProbePoint> row(i);
        const double f = contact.force(row, k);
        add(contact.node(row), k, f);
        squares += f * f;
        if (k == 2) pushed += f;
        largest = std::max(largest, std::abs(f));
      }
    for (int i = 0; i < contact.state.rows(); ++i)
      broken = std::max(broken, contact.state(Row<ProbePoint>(i), 4));
  }

  // Where a lever bends, the forces in its elements are far larger than those on it: they limit the
  // accuracy that the balance can have.
  void count_elements(const ElementForces& elements) {
    for (const double f : elements.hexahedra.values()) squares += f * f;
    if (elements.tetrahedra)
      for (const double f : elements.tetrahedra->values()) squares += f * f;
  }
};

}  // namespace

template <class Real>
void SolidFactors<Real>::factorise(const SolidAssembly& assembly, std::span<const Real> blocks) {
  const sparse::BlockGraph graph = graph_of(assembly);
  if (factors == nullptr)
    factors = std::make_unique<sparse::Factors<Real>>(graph, elimination_order(graph));
  stiffness = values_of(assembly, blocks);
  if (!factorise_stiffness(*this))
    throw RunFailure(
        fmt::format("factorise: the stiffness of the solid is singular ({} equations): a part is "
                    "not supported or has collapsed",
                    3 * graph.columns()));
}

template struct SolidFactors<double>;
template struct SolidFactors<long double>;

std::vector<double> SolidEquations::factorised() const {
  if (!has_factors()) return {};
  if (!in_extended) return plain.stiffness;
  const std::vector<long double>& k = extended.stiffness;
  std::vector<double> values(k.begin(), k.end());
  for (const long double v : k) values.push_back(static_cast<double>(v - static_cast<double>(v)));
  return values;
}

void SolidEquations::factorise_again(std::vector<double> values) {
  if (values.empty()) {
    plain.factors.reset();
    extended.factors.reset();
    return;
  }
  in_extended ? refactorise(extended, values) : refactorise(plain, values);
  answers.clear();
}

void residual::operator()() const {
  Balance balance{*mesh, equations->residual};
  balance.sum.setZero(3 * mesh->unknowns);
  // Where adhesion and pressure balance, the adhesion is the only force left to compare with.
  const double pull_off = contact ? contact->target->pull_off : 0;
  balance.squares = pull_off * pull_off;
  balance.largest = pull_off;
  balance.add_loads(applied, force);
  if (contact) balance.add_contact(*contact);
  const double largest = balance.largest, broken = balance.broken;
  equations->largest_force = largest;
  equations->contact_error = broken == 0 ? 0 : broken / std::max(largest, broken);
  balance.count_elements(elements);
  equations->scale = std::sqrt(balance.squares);
  equations->set_point_error =
      contact && contact->target->servo
          ? (contact->target->set_point - balance.pushed) / std::abs(contact->target->set_point)
          : 0;
}

void factorise::operator()() const {
  equations->answers.clear();
  equations->plain.factorise(*assembly, block.values());
}

void newton_direction::operator()() const {
  equations->direction = equations->solve(equations->residual);
}

}  // namespace pulvis
