// The rigid box or round die that a powder is packed in: floor at z = 0, walls, and a punch that presses from above.
// The origin is the corner of a box, or the centre of a cylinder's floor. Lengths in units of a mean diameter.
#pragma once

#include "scenes/space/packing/rigid_contact.hpp"

namespace pulvis::space {

struct Container {
  ContainerSpec::Kind kind = ContainerSpec::Kind::box;
  double width = 0, depth = 0;  // for a box
  double radius = 0;            // for a cylinder

  double floor_area() const;
  bool round() const { return kind == ContainerSpec::Kind::cylinder; }
};

// Walls, floor and punch are numbered from 0.
int walls_of(const Container& container);

// Deepest point of a particle in one of them; normal into the powder. None if it is farther away than `range`.
std::optional<RigidTouch> wall_touch(const Container& container, double height, int wall,
                                     const RigidShape& shape, const RigidPose& pose, double range);

// The same for a round wall around the z axis only.
std::optional<RigidTouch> round_wall_touch(double radius, const RigidShape& shape,
                                           const RigidPose& pose, double range);

}  // namespace pulvis::space
