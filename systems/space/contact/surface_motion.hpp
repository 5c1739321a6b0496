// How fast two surfaces may move against each other (SurfaceMotion).
#pragma once

#include <array>
#include <cmath>

#include "components/bundles.hpp"
#include "components/space/contact.hpp"

namespace pulvis::space {

// Of a pair whose other particle is a periodic image: points in contact are moved to where they are relative to the particle
// itself.
struct OtherImage {
  bool is_there = false;
  Point shift{}, velocity{};  // m, m/s

  OtherImage() = default;
  OtherImage(const CellImages<ThreeD>& images, Row<FaceContact> row)
      : is_there(images.of(row) != ImageIn<ThreeD>{}),
        shift(images.shift(row)),
        velocity(images.velocity(row)) {}

  using Points = std::array<double, 3 * face_points>;  // all x, y, z
  void move(Points& places, Points& velocities) const {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t g = 0; g < face_points; ++g) {
        places[face_points * k + g] -= shift[k];
        velocities[face_points * k + g] -= velocity[k];
      }
  }
};

// m/s, of any point of one surface against any of the other, at most. `image`: m/s, of the other one's periodic image
// relative to it.
inline double relative_speed(const Read<SurfaceMotion>& of, int slot, int other,
                             const Point& image = {}) {
  const double *a = &of(Row<WholeSurface>(slot)), *b = &of(Row<WholeSurface>(other));
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double apart = a[k] - b[k] - image[k];
    square += apart * apart;
  }
  return std::sqrt(square) + a[SurfaceMotion::difference] + b[SurfaceMotion::difference];
}

}  // namespace pulvis::space
