// The equations of an equilibrium iteration: the sparse stiffness of the solid and its factors, the
// residual, and the direction of Newton's step. Seen by systems only.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "components/solid.hpp"

namespace pulvis {

// In one precision. Bending of a lever is what is left of its stiffness in thickness: 1e-16 (L/t)^4 of it is
// lost in double, and 1e-19 (L/t)^4 in long double.
template <class Real>
struct SolidFactors {
  using Matrix = Eigen::SparseMatrix<Real, Eigen::ColMajor, int>;
  using Factors = Eigen::SimplicialLDLT<Matrix, Eigen::Lower>;

  Matrix stiffness;  // lower triangle, [3 unknowns]^2, N/m
  std::unique_ptr<Factors> factors;

  // Makes the factors, and the pattern at first; throws RunFailure where there are none.
  void factorise(const SolidAssembly& assembly, std::span<const Real> blocks);  // [blocks, 3, 3]
  // K^-1 of three forces. Solved one after the other, every difference would wait for the one before it; side by side they take
  // a third of the time, and each has the bits that it has alone.
  using Three = Eigen::Matrix<Real, Eigen::Dynamic, 3>;
  Three solve_three(const Three& forces) const;
  // Of a stable solid; round-off can lose it.
  bool positive() const { return factors != nullptr && (factors->vectorD().array() > 0).all(); }
};

struct SolidEquations {
  static constexpr const char* resource_name = "solid_equations";

  SolidFactors<double> plain;  // one of the two
  SolidFactors<long double> extended;
  bool in_extended = false;
  Eigen::VectorXd residual;    // [3 unknowns] N: applied - of the stresses
  Eigen::VectorXd direction;   // [3 unknowns] m
  double scale = 0;            // N, the forces that must balance: root of the sum of squares
  double set_point_error = 0;  // -, of the servo: what is missing over the set point
  // Of the contact, together with the direction:
  bool contact_solved = true;  // an answer was found
  double contact_error = 0;    // -, by how much the forces break the law, over the largest
  // By how much forces, over the largest, or places, over the scanner's displacement, change in the step that fulfils the law.
  double contact_change = 0;
  double largest_force = 0;    // N, of the probe's points
  Eigen::VectorXd force_step;  // [3 points] N, of the probe
  double height_step = 0;      // m, of the servo
  double released = 0;         // J, by a jump
  bool jumped = false;         // in this search for an equilibrium
  // Increments to come that do not try the factors of the one before, and how many those will be after the next failure:
  int fresh_increments = 0, fresh_after_failure = 1;
  // [points] K^-1 to unit forces on the point, [3 unknowns, 3]; empty until it was asked for
  std::vector<Eigen::MatrixXd> answers;

  // Where an increment had no use for old factors the next ones hardly will: twice as many after every failure, since a
  // press that turns the tip far may be followed by a scan that does not.
  void rest_from_old_factors() {
    fresh_increments = fresh_after_failure;
    fresh_after_failure = std::min(2 * fresh_after_failure, 16);
  }

  bool has_factors() const { return plain.factors != nullptr || extended.factors != nullptr; }
  bool positive() const { return in_extended ? extended.positive() : plain.positive(); }
  Eigen::VectorXd solve(const Eigen::VectorXd& forces) const {  // [3 unknowns] N
    if (!in_extended) return plain.factors->solve(forces);
    using Wide = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
    const Wide wide = forces.cast<long double>();
    return Wide(extended.factors->solve(wide)).cast<double>();
  }
  SolidFactors<double>::Three solve_three(const SolidFactors<double>::Three& forces) const {
    if (!in_extended) return plain.solve_three(forces);
    return extended.solve_three(forces.cast<long double>()).cast<double>();
  }

  // Factors may be older than the present stiffness of the solid; what they were made from makes them again,
  // and the answers.
  // Empty before the first factorisation; in long double the digits beyond a double follow.
  std::vector<double> factorised() const;
  void factorise_again(std::vector<double> values);  // throws BadState where the pattern is another
  template <class Bytes>
  void state(Bytes& bytes) {
    std::vector<double> values = factorised();
    bytes(values, scale, set_point_error, contact_solved, contact_error, contact_change,
          largest_force, height_step, released, jumped, fresh_increments, fresh_after_failure);
    if constexpr (Bytes::reads) factorise_again(std::move(values));
  }
};

}  // namespace pulvis
