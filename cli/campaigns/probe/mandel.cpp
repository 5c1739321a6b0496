#include "cli/campaigns/probe/mandel.hpp"

#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

// Unit deviators: stretched along z, and along x while compressed along y.
Mandel stretched() { return Mandel(-1, -1, 2, 0, 0, 0) / std::sqrt(6.0); }
Mandel sideways() { return Mandel(1, -1, 0, 0, 0, 0) / std::numbers::sqrt2; }

}  // namespace

Mandel mandel_of(const TensorParts& parts) {
  Mandel m = Eigen::Map<const Mandel>(parts.data());
  m.tail<3>() *= std::numbers::sqrt2;
  return m;
}

TensorParts parts_of(const Mandel& m) {
  TensorParts parts{};
  Eigen::Map<Mandel>(parts.data()) = m;
  for (std::size_t k = 3; k < tensor_parts; ++k) parts[k] /= std::numbers::sqrt2;
  return parts;
}

double pressure_of(const Mandel& stress) { return -stress.head<3>().sum() / 3; }

Mandel deviator_of(const Mandel& stress) {
  Mandel s = stress;
  s.head<3>().array() += pressure_of(stress);
  return s;
}

double von_mises_of(const Mandel& stress) { return std::sqrt(1.5) * deviator_of(stress).norm(); }

AxialPlane axial_plane(Axis axis) {
  if (axis == Axis::y) return {Mandel::Unit(0), Mandel::Unit(1)};
  return {Mandel(1, 1, 0, 0, 0, 0) / std::numbers::sqrt2, Mandel::Unit(2)};
}

Mandel unit_deviator(double lode) {
  return -portable::cos(lode) * stretched() + portable::sin(lode) * sideways();
}

double lode_angle(const Mandel& stress) {
  const double angle = portable::atan2(stress.dot(sideways()), -stress.dot(stretched()));
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

}  // namespace pulvis
