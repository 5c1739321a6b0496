// Rotations by an angle, bitwise identical on every machine. (Eigen's use the library's sine.)
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "engine/portable_math.hpp"

namespace pulvis {

using Rotation = Eigen::Quaterniond;  // built from its four components, never from an angle

inline Eigen::Matrix2d rotation(double angle) {
  const double c = portable::cos(angle), s = portable::sin(angle);
  return Eigen::Matrix2d{{c, -s}, {s, c}};
}
inline Eigen::Matrix3d rotation_about_y(double angle) {
  const double c = portable::cos(angle), s = portable::sin(angle);
  return Eigen::Matrix3d{{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
}
inline Eigen::Matrix3d rotation_about_z(double angle) {
  const double c = portable::cos(angle), s = portable::sin(angle);
  return Eigen::Matrix3d{{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
}

}  // namespace pulvis
