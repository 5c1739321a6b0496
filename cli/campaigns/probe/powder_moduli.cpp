#include "cli/campaigns/probe/powder_moduli.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace pulvis {
namespace {

using Matrix = Eigen::MatrixXd;

// Those of the probed components, or back.
Matrix picked(const MandelMatrix& c, const std::vector<int>& parts) { return c(parts, parts); }
MandelMatrix placed(const Matrix& small, const std::vector<int>& parts) {
  MandelMatrix c = MandelMatrix::Zero();
  c(parts, parts) = small;
  return c;
}

MandelMatrix isotropic(double bulk, double shear) {
  MandelMatrix c = 2 * shear * MandelMatrix::Identity();
  c.topLeftCorner<3, 3>().array() += bulk - 2 * shear / 3;
  return c;
}

// Averages over all turns about z.
MandelMatrix transversely_isotropic(const MandelMatrix& c) {
  MandelMatrix t = MandelMatrix::Zero();
  const double sum = (c(0, 0) + c(1, 1)) / 2, plane = (sum + c(0, 1)) / 2,
               shear = ((sum - c(0, 1)) + c(3, 3)) / 4;  // of 2 G in the plane, half
  t(0, 0) = t(1, 1) = plane + shear;
  t(0, 1) = t(1, 0) = plane - shear;
  t(3, 3) = 2 * shear;
  t(2, 2) = c(2, 2);
  t(0, 2) = t(1, 2) = t(2, 0) = t(2, 1) = (c(0, 2) + c(1, 2)) / 2;
  t(4, 4) = t(5, 5) = (c(4, 4) + c(5, 5)) / 2;
  return t;
}

MandelMatrix orthotropic(const MandelMatrix& c) {
  MandelMatrix t = c.diagonal().asDiagonal();
  t.topLeftCorner<3, 3>() = c.topLeftCorner<3, 3>();
  return t;
}

}  // namespace

PowderModuli::PowderModuli(const MandelMatrix& c, std::vector<int> parts, bool in_space)
    : parts_(std::move(parts)), in_space_(in_space) {
  const Matrix small = picked(c, parts_);
  c_ = placed(small, parts_);
  inverse_ = placed(small.inverse(), parts_);
}

double PowderModuli::c(int row, int column) const {
  return c_(row - 1, column - 1) / std::sqrt((row > 3 ? 2 : 1) * (column > 3 ? 2 : 1));
}
bool PowderModuli::has(int part) const {
  return std::ranges::find(parts_, part - 1) != parts_.end();
}

double PowderModuli::bulk_modulus() const {
  if (in_space_) return c_.topLeftCorner<3, 3>().sum() / 9;
  return c_(0, 1) + 2 * shear_modulus() / 3;
}
double PowderModuli::shear_modulus() const {
  if (in_space_) return (c_.trace() - 3 * bulk_modulus()) / 10;
  return 0.5 * (0.5 * (c_(0, 0) + c_(1, 1)) - c_(0, 1));
}
double PowderModuli::youngs_modulus() const {
  const double k = bulk_modulus(), g = shear_modulus();
  return 9 * k * g / (3 * k + g);
}
double PowderModuli::poissons_ratio() const {
  const double k = bulk_modulus(), g = shear_modulus();
  return (3 * k - 2 * g) / (2 * (3 * k + g));
}

PowderModuli::Misfits PowderModuli::misfits() const {
  const auto to = [&](const MandelMatrix& closest) { return (c_ - closest).norm() / c_.norm(); };
  return {to(isotropic(bulk_modulus(), shear_modulus())), to(transversely_isotropic(c_)),
          to(orthotropic(c_))};
}

std::vector<std::pair<std::string, double>> PowderModuli::engineering_constants() const {
  const MandelMatrix& s = inverse_;
  const auto ratio = [&](int by, int of) { return -s(by, of) / s(by, by); };
  return {{"E_x", 1 / s(0, 0)},        {"E_y", 1 / s(1, 1)},        {"E_z", 1 / s(2, 2)},
          {"nu_xy", ratio(0, 1)},      {"nu_yz", ratio(1, 2)},      {"nu_xz", ratio(0, 2)},
          {"G_xy", 1 / (2 * s(3, 3))}, {"G_yz", 1 / (2 * s(4, 4))}, {"G_zx", 1 / (2 * s(5, 5))}};
}

bool PowderModuli::are_of_a_solid() const {
  return picked(c_, parts_).selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() > 0;
}

Mandel PowderModuli::elastic_strain(const Mandel& stress) const { return inverse_ * stress; }

PowderModuli moduli_of(const std::vector<ProbeCurve>& curves, bool in_space,
                       double elastic_strain) {
  MandelMatrix squares = MandelMatrix::Zero(), products = MandelMatrix::Zero();
  for (const ProbeCurve& curve : curves)
    for (std::size_t i = 1; i < curve.strain.size(); ++i) {
      const Mandel& strain = curve.strain[i];
      if (strain.norm() > elastic_strain) break;
      squares += strain * strain.transpose();
      products += (curve.stress[i] - curve.stress[0]) * strain.transpose();
    }
  // A run that failed leaves a component of shear without a probe.
  constexpr double few = 1e-6;
  std::vector<int> parts;
  for (int k = 0; k < squares.rows(); ++k)
    if (squares(k, k) > few * squares.diagonal().maxCoeff()) parts.push_back(k);
  if (parts.empty()) return {};
  const Matrix c = picked(products, parts) * picked(squares, parts).inverse();
  return {placed(0.5 * (c + c.transpose()), parts), parts, in_space};
}

}  // namespace pulvis
