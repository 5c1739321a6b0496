// A tool that is to bear a set force F_set while it bears F:
//   m dw/dt = F_set - F,   v = w + (F_set - F)/c
// It moves as if the set force pushed it through a mass m and a dashpot c in series (a proportional and an
// integral part, as a control engineer would say). Both are passive, so that no compact, however stiff or
// layered, is made to swing by it; the dashpot takes up waves; and what is left of the force error, m dw/dt,
// is small where m is a small share of the powder's own mass. Source: impedances in series, e.g. Colgate and
// Hogan 1988, Int. J. Control 48, 65 (a passive controller is stable against every passive environment).
#pragma once

#include <algorithm>

namespace pulvis::kernels {

struct ServoStep {
  double momentum;  // kg m/s, m w
  double velocity;  // m/s
};

// `missing`: F_set - F, N. No faster than `fastest`, and the mass does not run up more than that either.
inline ServoStep servo_step(double momentum, double missing, double mass, double damping,
                            double fastest, double dt) {
  const double next = std::clamp(momentum + missing * dt, -mass * fastest, mass * fastest);
  return {next, std::clamp(next / mass + missing / damping, -fastest, fastest)};
}

}  // namespace pulvis::kernels
