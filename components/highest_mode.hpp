// Columns for estimating the highest eigenfrequency of each particle (systems/body/highest_mode): present only if
// the scene derives its time step from it.
#pragma once

#include "components/dimension.hpp"
#include "components/entities.hpp"

namespace pulvis {

template <class D>
struct HighestMode : Component<Node, double, 2 * D::axes> {
  static constexpr ComponentInfo info{
      "highest_mode", "-",
      D::axes == 2 ? "fastest oscillation as known so far, x y; room for the elastic forces"
                   : "fastest oscillation as known so far, x y z; room for the elastic forces"};
};
struct ModeGain : Component<Particle, double, 2> {
  static constexpr ComponentInfo info{
      "mode_gain", "-",
      "stable step over its elements' bound; looks since that was determined, 0: not yet"};
};
struct ContactSupport : Component<BoundaryNode, double, 1> {
  static constexpr ComponentInfo info{
      "contact_support", "-",
      "spring over k K of a node whose edges, or faces, are all in contact"};
};

}  // namespace pulvis
