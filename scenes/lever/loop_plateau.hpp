// Whether the force along a scan has come to its plateau: friction slides, points along the scan and drifts no
// more; and how far a scan has to go until then.
//
// Source   A press leaves friction along the lever, where it bent to. The scan turns it: with psi its angle to the
//          scan, k the lever's stiffness across the scan, s the distance slid, friction mu N against the slip,
//            mu N cos psi dpsi/ds = -k tan psi,   ln tan(psi/2) + cos psi = const - s k/(mu N)
//          What has turned draws with cos psi of its size.
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct AfmHistory;

struct Plateau {
  double slides = 0;  // -, mean share of the touching points that slide
  double turned =
      1;  // -, mean share of friction that points along the scan, where the surface tells it
  double drift =
      0;  // N, of the force along the scan: mean of the window's second half less its first's
  double needed = 0;  // m, a scan whose second half lies on the plateau; 0: nothing tells it
};

// Of one direction of the scan `action`, trace or retrace, over its second half.
Plateau plateau_of(const Scene& scene, const AfmHistory& history, std::size_t action, bool retrace);

}  // namespace pulvis
