// The true surface of a shape as seen from its centre of volume: its distance along each direction.
#pragma once

#include <memory>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

class StarSurface {
 public:
  virtual ~StarSurface() = default;
  // `direction`: unit vector.
  virtual double radius(const Vec3& direction) const = 0;  // m
  virtual Vec3 normal(const Vec3& direction) const = 0;    // outward unit vector there
  // Both: many surfaces need the radius for the normal.
  struct Spot {
    double radius;
    Vec3 normal;
  };
  virtual Spot spot(const Vec3& direction) const { return {radius(direction), normal(direction)}; }
  // m, from the centre along x, y, z: of a box of roughly the same proportions.
  virtual Vec3 half_size() const = 0;
  virtual double volume() const = 0;  // m^3, exact
  // How round the sections z = const of its box are: 0 (square) to 1.
  virtual double roundness() const { return 0; }

  Vec3 point(const Vec3& direction) const { return radius(direction) * direction; }
  // Unit vector along which a point on the surface of the cube [-1, 1]^3 is projected onto this one, for a mesh.
  Vec3 direction_of(const Vec3& on_cube) const;
};

std::unique_ptr<StarSurface> star_surface(const ParticleShape& shape);

}  // namespace pulvis::space
