// Columns and resources of a probe in contact with a rigid target: the probe points that can touch,
// and the target, which the scanner moves under it. Present only if the scene has a surface.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "engine/component.hpp"

namespace pulvis {

struct ProbePoint {  // a node of the probe's surface, or the end of a sharp tip
  static constexpr const char* name = "probe_point";
  static constexpr bool laned = false, by_chunk = false;
};

struct ProbeNode : Component<ProbePoint, std::int32_t, 1> {
  static constexpr ComponentInfo info{"node", "-", "of the solid, that the point is"};
};
struct ProbeStiffness : Component<ProbePoint, double, 2> {
  static constexpr ComponentInfo info{"stiffness", "N/m", "of the penalties: normal, tangential"};
};
struct ProbeShare : Component<ProbePoint, double, 1> {
  static constexpr ComponentInfo info{"share", "-", "of the pull-off force that acts on the point"};
};
// State variables that a point carries from one increment to the next.
struct ProbeMemory : Component<ProbePoint, double, 7> {
  static constexpr ComponentInfo info{
      "memory", "N, m, -",
      "tangential force, place on the target, whether it touched, of the last equilibrium"};
};
struct ProbeForce : Component<ProbePoint, double, 3> {
  static constexpr ComponentInfo info{"force", "N", "of the target on the point"};
};
struct ProbeState : Component<ProbePoint, double, 5> {
  static constexpr ComponentInfo info{
      "state", "m, N, N, -, N",
      "gap, pressing force, limit of friction, 0 apart 1 sticks 2 slides, by how much the force "
      "breaks the law of contact"};
};

// The rigid surface: signed distance of a point from it, and the outward normal.
struct TargetShape {
  using Place = std::array<double, 3>;
  struct Nearest {
    double distance = 0;  // m, < 0 inside
    Place normal{0, 0, 1};
    std::array<double, 9> turn{};  // 1/m, d normal / d place, row by row
  };
  virtual ~TargetShape() = default;
  virtual Nearest nearest(const Place& place) const = 0;
};

// An elastic sphere with adhesion (JKR); work 0: no adhesion.
struct AdhesiveBall {
  double modulus = 0, radius = 0, work = 0;  // E/(1 - nu^2) Pa, m, J/m^2
};

struct Target {
  static constexpr const char* resource_name = "target";
  std::shared_ptr<const TargetShape> shape;
  std::array<double, 3> origin{};  // m, origin of the shape, at first contact
  std::array<double, 3> travel{};  // m, displacement of the scanner since then
  double friction = 0;             // -, Coulomb
  double pull_off = 0;             // N, adhesion force at contact; 0: none
  AdhesiveBall ball;      // its law replaces the normal penalty and the DMT force
  double range = 0;       // m, decay length of adhesion: 1/(1 + gap/range)^2
  double end_radius = 0;  // m, end radius of a sharp tip; 0 for nodes of a meshed surface
  bool servo = false;     // the height of the scanner is controlled so that ...
  double set_point = 0;   // N, ... the target pushes the probe up with this force
  bool may_jump = false;  // if there is no equilibrium nearby, the probe may snap on or off

  // All other members come from the scene.
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(travel, servo, set_point, may_jump);
  }
};

}  // namespace pulvis
