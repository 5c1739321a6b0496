// residual, factorise, newton_direction: the equations of an equilibrium iteration.
//
// Source   K du = r with the lower triangle of K by columns; Eigen's simplicial L D L^T, whose ordering
//          (approximate minimum degree) is found once: the pattern never changes.
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
  const auto blocks = static_cast<int>(assembly.column_begin.size()) - 1;
  k.resize(3 * blocks, 3 * blocks);
  std::vector<int> sizes(static_cast<std::size_t>(3 * blocks));
  for (int c = 0; c < blocks; ++c) {
    const int below = assembly.column_begin[static_cast<std::size_t>(c) + 1] -
                      assembly.column_begin[static_cast<std::size_t>(c)];
    for (int j = 0; j < 3; ++j) sizes[static_cast<std::size_t>(3 * c + j)] = 3 * below - j;
  }
  k.reserve(sizes);
  for (int c = 0; c < blocks; ++c)
    for (int j = 0; j < 3; ++j)
      for (int b = assembly.column_begin[static_cast<std::size_t>(c)];
           b < assembly.column_begin[static_cast<std::size_t>(c) + 1]; ++b) {
        const int r = assembly.block_row[static_cast<std::size_t>(b)];
        for (int i = r == c ? j : 0; i < 3; ++i) k.insert(3 * r + i, 3 * c + j) = 0;
      }
  k.makeCompressed();
}

// Blocks of a column lie in rising order of rows, the diagonal one first: so do its numbers.
template <class Matrix, class Real>
void fill_values(const SolidAssembly& assembly, std::span<const Real> block, Matrix& k) {
  auto* value = k.valuePtr();
  const auto blocks = static_cast<int>(assembly.column_begin.size()) - 1;
  for (int c = 0; c < blocks; ++c)
    for (int j = 0; j < 3; ++j)
      for (int b = assembly.column_begin[static_cast<std::size_t>(c)];
           b < assembly.column_begin[static_cast<std::size_t>(c) + 1]; ++b) {
        const bool diagonal = assembly.block_row[static_cast<std::size_t>(b)] == c;
        for (int i = diagonal ? j : 0; i < 3; ++i)
          *value++ = block[static_cast<std::size_t>(9 * b + 3 * i + j)];
      }
}

// That of a large solid takes minutes. Interrupted, the solid is left without factors.
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

}  // namespace

template <class Real>
void SolidFactors<Real>::factorise(const SolidAssembly& assembly, std::span<const Real> blocks) {
  const bool first = factors == nullptr;
  if (first) make_pattern(assembly, stiffness);
  fill_values(assembly, blocks, stiffness);
  factorise_stiffness(*this, first);
  if (factors->info() != Eigen::Success || !factors->vectorD().allFinite())
    throw RunFailure(fmt::format(
        "factorise: the stiffness of the solid is singular ({} equations): a part hangs loose or "
        "has collapsed",
        stiffness.rows()));
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

void residual(Read<SolidMesh> mesh, Read<ElementForce> element,
              Optional<Read<TetrahedronForce>> tetrahedron, Read<SolidForce> force,
              Read<AppliedForce> applied, Optional<Read<Target>> target,
              Optional<Read<ProbeNode>> node, Optional<Read<ProbeForce>> probe,
              Optional<Read<ProbeState>> state, Write<SolidEquations> equations) {
  auto& r = equations->residual;
  r.setZero(3 * mesh->unknowns);
  const auto add = [&](int n, int k, double f) {
    for (const auto& support : mesh->supports_of(n))
      r[3 * mesh->unknown[static_cast<std::size_t>(support.node)] + k] += support.weight * f;
  };
  // Where adhesion and pressure balance, no force is left to compare with but the adhesion.
  const double pull_off = target ? (*target)->pull_off : 0;
  double squares = pull_off * pull_off, pushed = 0, largest = pull_off, broken = 0;
  for (int n = 0; n < force.rows(); ++n)
    for (int k = 0; k < 3; ++k) {
      const Row<SolidNode> row(n);
      add(n, k, applied(row, k) - force(row, k));
      squares += applied(row, k) * applied(row, k);
    }
  for (int i = 0; probe && i < probe->rows(); ++i)
    for (int k = 0; k < 3; ++k) {
      const double f = (*probe)(Row<ProbePoint>(i), k);
      add((*node)(Row<ProbePoint>(i)), k, f);
      squares += f * f;
      if (k == 2) pushed += f;
      largest = std::max(largest, std::abs(f));
    }
  for (int i = 0; state && i < state->rows(); ++i)
    broken = std::max(broken, (*state)(Row<ProbePoint>(i), 4));
  equations->largest_force = largest;
  equations->contact_error = broken == 0 ? 0 : broken / std::max(largest, broken);
  // Where a lever bends, the forces in its elements are far larger than those on it: they set the digits
  // that the balance can have.
  for (const double f : element.values()) squares += f * f;
  if (tetrahedron)
    for (const double f : tetrahedron->values()) squares += f * f;
  equations->scale = std::sqrt(squares);
  const bool servo = target && (*target)->servo;
  equations->set_point_error =
      servo ? ((*target)->set_point - pushed) / std::abs((*target)->set_point) : 0;
}

void factorise(Read<SolidAssembly> assembly, Read<BlockTangent> block,
               Write<SolidEquations> equations) {
  equations->answers.clear();
  equations->plain.factorise(*assembly, block.values());
}

void newton_direction(Write<SolidEquations> equations) {
  equations->direction = equations->solve(equations->residual);
}

}  // namespace pulvis
