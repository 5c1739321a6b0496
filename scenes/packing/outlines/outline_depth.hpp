// Penetration depth of placed outlines.
#pragma once

#include <vector>

#include "scenes/outlines/outline.hpp"
#include "scenes/packing/outlines/rigid_contact.hpp"

namespace pulvis {

// Outlines other than rounded boxes are treated as inscribed polygons with this deviation, relative to the
// root of their area: touching ones count as apart, and an overlap below twice of it is not detected.
inline constexpr double check_deviation = 1e-4;

std::vector<Vec2> check_polygon(const Outline& outline);

class OutlineDepths {
 public:
  explicit OutlineDepths(const Scene& scene);

  // m, negative if they are apart; exact between rounded boxes.
  double between(const BodySpec& a, const BodySpec& b);

 private:
  RigidPose pose(const BodySpec& body) const;

  std::vector<std::optional<RoundedBox>> boxes_;  // by class
  std::vector<RigidShape> shapes_;                // by class; of all, if one is not a box
  double unit_ = 0;                               // m
  RigidContacts contacts_;
};

}  // namespace pulvis
