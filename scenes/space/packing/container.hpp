// The rigid box or round die that a powder is packed in: floor at z = 0, walls, and a punch that presses on it from above.
// Of a box the corner is the origin, of a cylinder the centre of its floor. Lengths in units of a mean diameter.
#pragma once

#include "scenes/space/packing/rigid_contact.hpp"

namespace pulvis::space {

struct Container {
  ContainerSpec::Kind kind = ContainerSpec::Kind::box;
  double width = 0, depth = 0;  // of a box
  double radius = 0;            // of a cylinder

  double floor_area() const;
  bool round() const { return kind == ContainerSpec::Kind::cylinder; }
};

// Walls, floor and punch are counted from 0.
int walls_of(const Container& container);

// Deepest point of a particle in one of them; normal into the powder. None where it is farther away than `range`.
std::optional<RigidTouch> wall_touch(const Container& container, double height, int wall,
                                     const RigidShape& shape, const RigidPose& pose, double range);

// The same of a round wall about the z axis alone.
std::optional<RigidTouch> round_wall_touch(double radius, const RigidShape& shape,
                                           const RigidPose& pose, double range);

}  // namespace pulvis::space
