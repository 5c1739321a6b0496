// The rigid die that outlines are packed in, with the left wall at x = 0, the floor at y = 0 and a punch that presses
// from above; or a periodic cell. And how outlines move in it. Lengths in units of a mean diameter. The counterpart in
// three dimensions is scenes/packing/solids/container.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scenes/packing/outlines/rigid_contact.hpp"

namespace pulvis {

struct Container {
  double width = 0;
  bool periodic = false;

  double floor() const { return width; }
  // Of a powder with this content (area) at a density.
  double height_at(double density, double content) const { return content / (density * width); }
  bool operator==(const Container&) const = default;
};

// Walls, floor and punch are numbered from 0.
inline int walls_of(const Container& container) { return container.periodic ? 0 : 4; }

// Deepest corner of a particle in one of them; normal into the powder. None if it is farther away than `range`.
std::optional<RigidTouch> wall_touch(const Container& container, double height, int wall,
                                     const RigidShape& shape, const RigidPose& pose, double range);

struct NearPair {
  std::int32_t a, b;
  std::int32_t x = 0, y = 0;  // periods by which b is shifted
};
// All pairs whose circles around their centroids, of these radii, have a gap below `range`.
std::vector<NearPair> near_pairs(const Container& container, double height,
                                 const std::vector<RigidPose>& poses,
                                 const std::vector<double>& radii, double range);

inline double& height_of(RigidPose& pose) { return pose.at.y; }
RigidPose random_pose(const Container& container, double height, const RigidShape& shape,
                      portable::Random& random);
RigidPose shaken(const RigidPose& pose, const RigidShape& shape, double displacement,
                 portable::Random& random);  // by at most this, in diameters
// As it moved since `before`, times `share`.
RigidPose carried_on(const RigidPose& pose, const RigidPose& before, const RigidShape& shape,
                     double share);
// Like an impulse along `correction` at `arm` from the centroid, whose magnitude is the length of `correction` in units
// of area.
RigidPose corrected(const RigidPose& pose, const RigidShape& shape, const portable::V2& arm,
                    const portable::V2& correction);
// How much more mobile the particle is at `arm` along a normal than at its centroid, minus 1.
double leverage(const RigidShape& shape, const portable::V2& arm, const portable::V2& normal);

}  // namespace pulvis
