// Stresses and strains as vectors of six components in which lengths and angles are those of the tensors.
#pragma once

#include <Eigen/Core>
#include <array>

#include "scenes/spec/cell_spec.hpp"

namespace pulvis {

// xx yy zz, then sqrt(2) times xy yz zx (Mandel 1965): the order of tensor_part_names.
using Mandel = Eigen::Matrix<double, tensor_parts, 1>;
using MandelMatrix = Eigen::Matrix<double, tensor_parts, tensor_parts>;

using TensorParts = std::array<double, tensor_parts>;
Mandel mandel_of(const TensorParts& parts);
TensorParts parts_of(const Mandel& m);

double pressure_of(const Mandel& stress);   // Pa, -trace/3
Mandel deviator_of(const Mandel& stress);   // without the pressure
double von_mises_of(const Mandel& stress);  // Pa, >= 0

// The axis along which a powder is pressed: y in two dimensions, z in three.
enum class Axis { y = 1, z = 2 };

// Unit vectors of the plane that contains the axis and the pressure. In two dimensions they are xx and yy, in three the
// lateral one, (xx + yy)/sqrt(2), and zz: the plane of triaxial compression and extension.
struct AxialPlane {
  Mandel across, along;
};
AxialPlane axial_plane(Axis axis);

// Unit deviator compressed along z by the Lode angle 0; at 120 degrees along y, at 240 along x. At 60, 180 and 300 degrees it
// is stretched along x, z and y.
Mandel unit_deviator(double lode);        // rad
double lode_angle(const Mandel& stress);  // rad, 0 to 2 pi

}  // namespace pulvis
