// Particles as rigid convex bodies, for packing. Each is defined by its support function: the point that lies farthest
// along a direction. Spheres, ellipsoids, superquadrics and cylinders with rounded rims have closed forms; polyhedra and STL
// shapes are the convex hull of points, each with a sphere around it.
#pragma once

#include "scenes/packing/solids/support_table.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

struct RigidShape {
  enum class Core { point, ellipsoid, superquadric, cylinder, points } core = Core::point;
  V3 half;  // ellipsoid, superquadric: half axes; cylinder: radius, radius, half height
  double exponent_xy = 2,
         exponent_z = 2;  // for a superquadric's support function: e/(e-1), f/(f-1)
  SupportTable table;
  double radius = 0;    // of the sphere around every point of the core
  double reach = 0;     // of the sphere around the centre of volume that encloses the shape
  double content = 0;   // volume
  double gyration = 0;  // square of a mean radius of gyration
  double diameter = 0;  // of the sphere of equal volume

  bool operator==(const RigidShape&) const = default;
  bool is_ball() const { return core == Core::point; }
  V3 support(const V3& n) const;  // n: unit vector

 private:
  V3 core_support(const V3& n) const;
};

// In units of `unit` (m).
RigidShape rigid_shape(const ParticleShape& shape, double unit);

// Enlarged by the bulge of the mesh's smooth surface, which contacts use, beyond the true one if that is significant:
// otherwise particles that touch by their true surfaces would be pressed into each other.
RigidShape contact_shape(const ParticleSpec& particle, double unit);

inline V3 vector_of(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
inline Turn turn_of(const Rotation& q) { return {q.w(), q.x(), q.y(), q.z()}; }

double volume_of(const ParticleShape& shape);    // m^3
double diameter_of(const ParticleShape& shape);  // m, of the sphere of equal volume
ParticleShape scaled(const ParticleShape& shape, double factor);

}  // namespace pulvis::space
