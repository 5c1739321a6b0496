// The equations of an equilibrium iteration: the sparse stiffness of the solid and its factors, the
// residual, and the Newton direction. Used by systems only.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "components/solid.hpp"
#include "systems/sparse/factors.hpp"

namespace pulvis {

// In one precision. The bending stiffness of a lever is a small remainder of its thickness stiffness: 1e-16 (L/t)^4 of
// it is lost in double, and 1e-19 (L/t)^4 in long double.
template <class Real>
struct SolidFactors {
  std::vector<Real> stiffness;  // N/m, of the lower triangle, as sparse::Factors takes it
  std::unique_ptr<sparse::Factors<Real>> factors;

  // Factorises, and finds the pattern the first time; throws RunFailure if there is no factorisation.
  void factorise(const SolidAssembly& assembly, std::span<const Real> blocks);  // [blocks, 3, 3]
  // K^-1 times forces: [3 unknowns, n].
  template <class Forces>
  Forces solve(Forces forces) const {
    factors->solve({forces.data(), static_cast<std::size_t>(forces.size())});
    return forces;
  }
  // True for a stable solid; round-off can destroy it.
  bool positive() const {
    return factors != nullptr &&
           std::ranges::all_of(factors->pivots(), [](Real d) { return d > 0; });
  }
};

struct SolidEquations {
  static constexpr const char* resource_name = "solid_equations";

  SolidFactors<double> plain;  // only one of the two is used
  SolidFactors<long double> extended;
  bool in_extended = false;
  Eigen::VectorXd residual;    // [3 unknowns] N: applied - internal
  Eigen::VectorXd direction;   // [3 unknowns] m
  double scale = 0;            // N, the forces that must balance: root sum of squares
  double set_point_error = 0;  // -, of the servo: missing force over the set point
  // Contact, solved together with the direction:
  bool contact_solved = true;  // a solution was found
  double contact_error = 0;    // -, violation of the contact law by the forces, over the largest
  // Change of forces, over the largest, or of positions, over the scanner's displacement, in the step that satisfies the law.
  double contact_change = 0;
  double largest_force = 0;    // N, on the probe's points
  Eigen::VectorXd force_step;  // [3 points] N, on the probe
  double height_step = 0;      // m, of the servo
  double released = 0;         // J, by a jump
  bool jumped = false;         // in this equilibrium search
  // Number of further increments that do not try the previous factors, and that number after the next failure:
  int fresh_increments = 0, fresh_after_failure = 1;
  // [points] K^-1 times unit forces on the point, [3 unknowns, 3]; empty until requested
  std::vector<Eigen::MatrixXd> answers;

  // If an increment could not use old factors the next ones hardly will: twice as many after every failure, since an
  // indentation that rotates the tip far may be followed by a scan that does not.
  void rest_from_old_factors() {
    fresh_increments = fresh_after_failure;
    fresh_after_failure = std::min(2 * fresh_after_failure, 16);
  }

  bool has_factors() const { return plain.factors != nullptr || extended.factors != nullptr; }
  bool positive() const { return in_extended ? extended.positive() : plain.positive(); }
  // K^-1 times forces: [3 unknowns, n] N. Several of them take less time together.
  template <class Forces>
  Forces solve(const Forces& forces) const {
    if (!in_extended) return plain.solve(forces);
    return extended.solve(forces.template cast<long double>().eval()).template cast<double>();
  }

  // Factors may be older than the current stiffness of the solid; the values they were made from are enough to
  // rebuild them, and the answers.
  // Empty before the first factorisation; in long double the digits beyond double precision follow.
  std::vector<double> factorised() const;
  void factorise_again(std::vector<double> values);  // throws BadState if the pattern differs
  template <class Bytes>
  void state(Bytes& bytes) {
    std::vector<double> values = factorised();
    bytes(values, scale, set_point_error, contact_solved, contact_error, contact_change,
          largest_force, height_step, released, jumped, fresh_increments, fresh_after_failure);
    if constexpr (Bytes::reads) factorise_again(std::move(values));
  }
};

}  // namespace pulvis
