// How deep placed outlines reach into each other.
#pragma once

#include <vector>

#include "scenes/outlines/outline.hpp"
#include "scenes/packing/rigid_contact.hpp"

namespace pulvis {

// Outlines that are no rounded boxes are looked at as inscribed polygons with this deviation, of the root of
// their area: two that touch are apart, and an overlap below twice of it is not seen.
inline constexpr double check_deviation = 1e-4;

std::vector<Vec2> check_polygon(const Outline& outline);

class OutlineDepths {
 public:
  explicit OutlineDepths(const Scene& scene);

  // m, negative where they are apart; between rounded boxes exact.
  double between(const BodySpec& a, const BodySpec& b);

 private:
  RigidPose pose(const BodySpec& body) const;

  std::vector<std::optional<RoundedBox>> boxes_;  // by class
  std::vector<RigidShape> shapes_;                // by class; of all, where one is no box
  double unit_ = 0;                               // m
  RigidContacts contacts_;
};

}  // namespace pulvis
