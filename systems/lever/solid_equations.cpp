// residual, factorise, newton_direction: the equations of an equilibrium iteration.
//
// Source   K du = r with the lower triangle of K by columns; Eigen's simplicial L D L^T, whose ordering
//          (approximate minimum degree) is computed once: the pattern never changes.
// Runs     after solid_force (residual) and block_tangent (factorise, then newton_direction)
// Active   when the scene has a lever
#include "systems/lever/solid_equations.hpp"

#include <fmt/format.h>

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

// The pattern of the scalar matrix from that of its blocks.
template <class Matrix>
void make_pattern(const SolidAssembly& assembly, Matrix& k) {
  const int blocks = assembly.columns();
  k.resize(3 * blocks, 3 * blocks);
  std::vector<int> sizes;
  for (int c = 0; c < blocks; ++c)
    for (int j = 0; j < 3; ++j)
      sizes.push_back(3 * static_cast<int>(assembly.rows_of(c).size()) - j);
  k.reserve(sizes);
  for (int c = 0; c < blocks; ++c)
    for (int j = 0; j < 3; ++j)
      for (const int r : assembly.rows_of(c))
        for (int i = r == c ? j : 0; i < 3; ++i) k.insert(3 * r + i, 3 * c + j) = 0;
  k.makeCompressed();
}

// Blocks of a column are in ascending order of rows, the diagonal one first: so are its values.
template <class Matrix, class Real>
void fill_values(const SolidAssembly& assembly, std::span<const Real> blocks, Matrix& k) {
  auto* value = k.valuePtr();
  const Real* column = blocks.data();  // [blocks of the column, 3, 3]
  for (int c = 0; c < assembly.columns(); ++c) {
    const auto rows = assembly.rows_of(c);
    for (int j = 0; j < 3; ++j) {
      const Real* block = column;
      for (const int r : rows) {
        for (int i = r == c ? j : 0; i < 3; ++i) *value++ = block[3 * i + j];
        block += 9;
      }
    }
    column += 9 * rows.size();
  }
}

// For a large solid this takes minutes. If interrupted, the solid is left without factors.
template <class Real>
void factorise_stiffness(SolidFactors<Real>& solid, bool first) {
  using Factors = typename SolidFactors<Real>::Factors;
  auto factors = first ? std::make_unique<Factors>() : std::move(solid.factors);
  std::tie(solid.stiffness, solid.factors) = interruptible(
      [stiffness = std::move(solid.stiffness), factors = std::move(factors), first]() mutable {
        if (first) factors->analyzePattern(stiffness);
        factors->factorize(stiffness);
        return std::pair(std::move(stiffness), std::move(factors));
      });
}

template <class Real>
void refactorise(SolidFactors<Real>& solid, const std::vector<double>& values) {
  constexpr std::size_t parts = std::is_same_v<Real, double> ? 1 : 2;
  const auto size = static_cast<std::size_t>(solid.stiffness.nonZeros());
  if (solid.factors == nullptr || values.size() != parts * size)
    throw BadState("the stiffness of the solid does not fit its mesh");
  for (std::size_t i = 0; i < size; ++i) {
    Real& k = solid.stiffness.valuePtr()[i];
    k = values[i];
    if (parts == 2) k += values[size + i];
  }
  factorise_stiffness(solid, false);
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
  const bool first = factors == nullptr;
  if (first) make_pattern(assembly, stiffness);
  fill_values(assembly, blocks, stiffness);
  factorise_stiffness(*this, first);
  if (factors->info() != Eigen::Success || !factors->vectorD().allFinite())
    throw RunFailure(
        fmt::format("factorise: the stiffness of the solid is singular ({} equations): a part is "
                    "not supported or has collapsed",
                    stiffness.rows()));
}

// L D L^T x = P b, then P^T x. Columns of L store the part below the diagonal, which is 1.
template <class Real>
typename SolidFactors<Real>::Three SolidFactors<Real>::solve_three(const Three& forces) const {
  Eigen::Matrix<Real, Eigen::Dynamic, 3, Eigen::RowMajor> x = factors->permutationP() * forces;
  const auto l = factors->matrixL();
  const auto* begin = l.nestedExpression().outerIndexPtr();
  const auto* row = l.nestedExpression().innerIndexPtr();
  const Real* value = l.nestedExpression().valuePtr();
  const Eigen::Matrix<Real, Eigen::Dynamic, 1> d = factors->vectorD();
  for (Eigen::Index c = 0; c < x.rows(); ++c) {
    const Real a0 = x(c, 0), a1 = x(c, 1), a2 = x(c, 2);
    if (a0 == 0 && a1 == 0 && a2 == 0) continue;
    for (auto i = begin[c]; i < begin[c + 1]; ++i) {
      Real* at = x.data() + 3 * row[i];
      at[0] -= a0 * value[i], at[1] -= a1 * value[i], at[2] -= a2 * value[i];
    }
  }
  for (Eigen::Index c = 0; c < x.rows(); ++c) x.row(c) *= 1 / d[c];
  for (Eigen::Index c = x.rows(); c-- > 0;) {
    Real a0 = x(c, 0), a1 = x(c, 1), a2 = x(c, 2);
    for (auto i = begin[c]; i < begin[c + 1]; ++i) {
      const Real* at = x.data() + 3 * row[i];
      a0 -= value[i] * at[0], a1 -= value[i] * at[1], a2 -= value[i] * at[2];
    }
    x(c, 0) = a0, x(c, 1) = a1, x(c, 2) = a2;
  }
  return factors->permutationPinv() * x;
}

template struct SolidFactors<double>;
template struct SolidFactors<long double>;

std::vector<double> SolidEquations::factorised() const {
  if (!has_factors()) return {};
  if (!in_extended)
    return {plain.stiffness.valuePtr(), plain.stiffness.valuePtr() + plain.stiffness.nonZeros()};
  const std::span<const long double> k(extended.stiffness.valuePtr(),
                                       static_cast<std::size_t>(extended.stiffness.nonZeros()));
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
