// Columns of the estimate of each particle's highest frequency (systems/highest_mode): there are none unless
// the scene takes its time step from it.
#pragma once

#include "components/places.hpp"

namespace pulvis {

struct HighestMode : Component<Node, double, 4> {
  static constexpr ComponentInfo info{
      "highest_mode", "-", "fastest oscillation as known so far, x y; room for the elastic forces"};
};
struct ContactSupport : Component<BoundaryNode, double, 1> {
  static constexpr ComponentInfo info{"contact_support", "-",
                                      "spring over k K of a node whose edges are all in contact"};
};

}  // namespace pulvis
