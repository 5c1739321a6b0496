// The equations of an equilibrium iteration: the sparse stiffness of the solid and its factors, the
// residual, and the direction of Newton's step. Seen by systems only.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace pulvis {

struct SolidEquations {
  static constexpr const char* resource_name = "solid_equations";
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
  using Factors = Eigen::SimplicialLDLT<Matrix, Eigen::Lower>;

  Matrix stiffness;  // lower triangle, [3 unknowns]^2, N/m
  std::unique_ptr<Factors> factors;
  Eigen::VectorXd residual;    // [3 unknowns] N: applied - of the stresses
  Eigen::VectorXd direction;   // [3 unknowns] m
  double scale = 0;            // N, the forces that must balance: root of the sum of squares
  double set_point_error = 0;  // -, of the servo: what is missing over the set point
  double height_step = 0;      // m, of the servo, together with the direction

  // Factors may be older than the present stiffness of the solid; what they were made from makes them again.
  std::vector<double> factorised() const;            // empty before the first factorisation
  void factorise_again(std::vector<double> values);  // throws BadState where the pattern is another
  template <class Bytes>
  void state(Bytes& bytes) {
    std::vector<double> values = factorised();
    bytes(values, scale, set_point_error, height_step);
    if constexpr (Bytes::reads) factorise_again(std::move(values));
  }
};

}  // namespace pulvis
