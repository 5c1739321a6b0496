// residual, factorise, newton_direction: the equations of an equilibrium iteration.
//
// Source   K du = r with the lower triangle of K by columns; Eigen's simplicial L D L^T, whose ordering
//          (approximate minimum degree) is found once: the pattern never changes.
// Runs     after solid_force (residual) and block_tangent (factorise, then newton_direction)
// Active   when the scene has a lever
#include "systems/solid_equations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/interruption.hpp"
#include "engine/state_bytes.hpp"
#include "systems/run_failure.hpp"
#include "systems/solid_systems.hpp"

namespace pulvis {
namespace {

// The pattern of the scalar matrix from that of its blocks.
void make_pattern(const SolidAssembly& assembly, SolidEquations& equations) {
  const auto blocks = static_cast<int>(assembly.column_begin.size()) - 1;
  auto& k = equations.stiffness;
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
void fill_values(const SolidAssembly& assembly, const Read<BlockTangent>& block,
                 SolidEquations& equations) {
  double* value = equations.stiffness.valuePtr();
  const auto blocks = static_cast<int>(assembly.column_begin.size()) - 1;
  for (int c = 0; c < blocks; ++c)
    for (int j = 0; j < 3; ++j)
      for (int b = assembly.column_begin[static_cast<std::size_t>(c)];
           b < assembly.column_begin[static_cast<std::size_t>(c) + 1]; ++b) {
        const bool diagonal = assembly.block_row[static_cast<std::size_t>(b)] == c;
        for (int i = diagonal ? j : 0; i < 3; ++i)
          *value++ = block(Row<StiffnessBlock>(b), 3 * i + j);
      }
}

// That of a large solid takes minutes. Interrupted, the equations are left empty.
void factorise_stiffness(SolidEquations& equations, bool first) {
  auto factors = first ? std::make_unique<SolidEquations::Factors>() : std::move(equations.factors);
  std::tie(equations.stiffness, equations.factors) = interruptible(
      [stiffness = std::move(equations.stiffness), factors = std::move(factors), first]() mutable {
        if (first) factors->analyzePattern(stiffness);
        factors->factorize(stiffness);
        return std::pair(std::move(stiffness), std::move(factors));
      });
}

}  // namespace

std::vector<double> SolidEquations::factorised() const {
  if (factors == nullptr) return {};
  return {stiffness.valuePtr(), stiffness.valuePtr() + stiffness.nonZeros()};
}

void SolidEquations::factorise_again(std::vector<double> values) {
  if (values.empty()) {
    factors.reset();
    return;
  }
  if (factors == nullptr || static_cast<std::ptrdiff_t>(values.size()) != stiffness.nonZeros())
    throw BadState("the stiffness of the solid does not fit its mesh");
  std::copy(values.begin(), values.end(), stiffness.valuePtr());
  factorise_stiffness(*this, false);
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
  const bool first = equations->factors == nullptr;
  if (first) make_pattern(*assembly, *equations);
  fill_values(*assembly, block, *equations);
  factorise_stiffness(*equations, first);
  equations->answers.clear();
  if (equations->factors->info() != Eigen::Success || !equations->factors->vectorD().allFinite())
    throw RunFailure(fmt::format(
        "factorise: the stiffness of the solid is singular ({} equations): a part hangs loose or "
        "has collapsed",
        equations->stiffness.rows()));
}

void newton_direction(Write<SolidEquations> equations) {
  equations->direction = equations->factors->solve(equations->residual);
}

}  // namespace pulvis
