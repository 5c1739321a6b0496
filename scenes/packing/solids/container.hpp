// The rigid box or round die that solids are packed in: floor at z = 0, walls, and a punch that presses from above; or a
// periodic cell. The origin is the corner of a box, or the centre of a cylinder's floor. And how solids move in it. Lengths in units of a
// mean diameter. The counterpart in two dimensions is scenes/packing/outlines/container.hpp.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scenes/outlines/portable.hpp"
#include "scenes/packing/solids/rigid_contact.hpp"

namespace pulvis::space {

struct Container {
  ContainerSpec::Kind kind = ContainerSpec::Kind::box;
  double width = 0, depth = 0;  // for a box
  double radius = 0;            // for a cylinder
  bool periodic = false;        // a box without walls

  double floor() const;  // its area
  // Of a powder with this content (volume) at a density.
  double height_at(double density, double content) const { return content / floor() / density; }
  bool round() const { return kind == ContainerSpec::Kind::cylinder; }
  bool operator==(const Container&) const = default;
};

// Walls, floor and punch are numbered from 0.
int walls_of(const Container& container);

// Deepest point of a particle in one of them; normal into the powder. None if it is farther away than `range`.
std::optional<RigidTouch> wall_touch(const Container& container, double height, int wall,
                                     const RigidShape& shape, const RigidPose& pose, double range);

// The same for a round wall around the z axis only.
std::optional<RigidTouch> round_wall_touch(double radius, const RigidShape& shape,
                                           const RigidPose& pose, double range);

struct NearPair {
  std::int32_t a, b;
  std::array<std::int32_t, 3> periods{};  // by which b is shifted
  V3 normal{0, 0, 1};                     // along which they were apart, or in contact, last
};
// How far that moves it.
inline V3 shift_of(const Container& container, double height,
                   const std::array<std::int32_t, 3>& periods) {
  return {periods[0] * container.width, periods[1] * container.depth, periods[2] * height};
}
// All pairs whose spheres around their centres, of these radii, have a gap below `range`.
std::vector<NearPair> near_pairs(const Container& container, double height,
                                 const std::vector<RigidPose>& poses,
                                 const std::vector<double>& radii, double range);

inline double& height_of(RigidPose& pose) { return pose.at.z; }
RigidPose random_pose(const Container& container, double height, const RigidShape& shape,
                      portable::Random& random);
RigidPose shaken(const RigidPose& pose, const RigidShape& shape, double displacement,
                 portable::Random& random);  // by at most this, in diameters
// As it moved since `before`, times `share`.
RigidPose carried_on(const RigidPose& pose, const RigidPose& before, const RigidShape& shape,
                     double share);
// Like an impulse along `correction` at `arm` from the centre, whose magnitude is the length of `correction` in units of
// volume.
RigidPose corrected(const RigidPose& pose, const RigidShape& shape, const V3& arm,
                    const V3& correction);
// How much more mobile the particle is at `arm` along a normal than at its centre, minus 1.
double leverage(const RigidShape& shape, const V3& arm, const V3& normal);

}  // namespace pulvis::space
