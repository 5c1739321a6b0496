// Declaration of particles that are placed one by one.
#include "engine/portable_math.hpp"
#include "scenes/keys/declare.hpp"

namespace pulvis::schema {
namespace {

std::vector<Key<BodySpec>> placed_keys() {
  return {{{.name = "particle",
            .kind = Kind::reference,
            .refers_to = "particle",
            .required = true,
            .doc = "Particle class."},
           index_to(&BodySpec::particle)},
          {{.name = "position",
            .kind = Kind::vector,
            .unit = "m",
            .range = within(-largest_size, largest_size),
            .required = true,
            .doc = "Centre of the outline, in three dimensions of the volume."},
           to(&BodySpec::position)}};
}

// Rotations by an angle in the plane; in three dimensions about an axis.
std::vector<Key<BodySpec>> turn_keys() {
  return {{{.name = "angle",
            .kind = Kind::quantity,
            .unit = "rad",
            .range = within(-1000, 1000),
            .fallback = value_of("0 deg"),
            .doc = "Rotation, counter-clockwise.",
            .dimension = Dimension::two},
           to(&BodySpec::angle)},
          {{.name = "angle",
            .kind = Kind::quantity,
            .unit = "rad",
            .range = within(-1000, 1000),
            .doc = "Rotation about `axis`, counter-clockwise when the axis points towards the "
                   "viewer.",
            .fallback_doc = "`\"0 deg\"`",
            .dimension = Dimension::three},
           [](BodySpec& spec, const Decoded& value) {
             const double half = value.number / 2;
             spec.rotation = Rotation(portable::cos(half), 0, 0, portable::sin(half));
           }},
          {{.name = "axis",
            .kind = Kind::direction,
            .needs = "angle",
            .doc = "Rotation axis, of any length.",
            .fallback_doc = "`[0, 0, 1]`",
            .dimension = Dimension::three},
           // The preceding key has set the angle, about z.
           [](BodySpec& spec, const Decoded& value) {
             const Vec3 part = spec.rotation.z() * value.vector3.normalized();
             spec.rotation = Rotation(spec.rotation.w(), part.x(), part.y(), part.z());
           }}};
}

std::vector<Key<BodySpec>> motion_keys() {
  return {{{.name = "velocity",
            .kind = Kind::vector,
            .unit = "m/s",
            .range = within(-1e5, 1e5),
            .fallback = zero_vector("0 m/s"),
            .doc = "Initial velocity of the centre."},
           to(&BodySpec::velocity)},
          {{.name = "angular_velocity",
            .kind = Kind::quantity,
            .unit = "rad/s",
            .range = within(-1e12, 1e12),
            .fallback = value_of("0 rad/s"),
            .doc = "Initial angular velocity, counter-clockwise.",
            .dimension = Dimension::two},
           [](BodySpec& spec, const Decoded& value) { spec.angular_velocity.z() = value.number; }},
          {{.name = "angular_velocity",
            .kind = Kind::vector,
            .unit = "rad/s",
            .range = within(-1e12, 1e12),
            .fallback = zero_vector("0 rad/s"),
            .doc = "Initial angular velocity, in the axes of the scene.",
            .dimension = Dimension::three},
           to(&BodySpec::angular_velocity)}};
}

}  // namespace

const TableDeclaration<BodySpec>& body() {
  static const TableDeclaration<BodySpec> declaration = [] {
    TableDeclaration<BodySpec> made{{"body", true, "", "A particle placed individually."},
                                    placed_keys()};
    for (const auto& more : {turn_keys(), motion_keys()})
      made.keys.insert(made.keys.end(), more.begin(), more.end());
    return made;
  }();
  return declaration;
}

}  // namespace pulvis::schema
