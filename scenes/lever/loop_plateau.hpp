// Whether the force along a scan has reached its plateau: all points slide, friction points along the scan and
// no longer drifts; and how long a scan has to be for that.
//
// Source   A press leaves friction along the lever, since the lever bends that way. The scan turns it: psi is its
//          angle to the scan, k the lever's stiffness across the scan, s the slip distance, mu N the friction,
//            mu N cos psi dpsi/ds = -k tan psi,   ln tan(psi/2) + cos psi = const - s k/(mu N)
//          After turning, friction drags with cos psi of its magnitude.
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct AfmHistory;

struct Plateau {
  double slides = 0;  // -, mean share of the contact points that slide
  double turned =
      1;  // -, mean share of friction that points along the scan, where the surface shows it
  double drift =
      0;  // N, of the force along the scan: mean of the window's second half minus its first's
  double needed = 0;  // m, scan length whose second half lies on the plateau; 0: not known
};

// For one direction of the scan `action`, trace or retrace, over its second half.
Plateau plateau_of(const Scene& scene, const AfmHistory& history, std::size_t action, bool retrace);

}  // namespace pulvis
