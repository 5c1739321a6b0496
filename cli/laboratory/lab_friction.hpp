// Friction coefficient between compact and target from the punch force and the shear force.
//
// Source   thesis, equations (3.1) and (3.2), after Cameron (2000): a cylindrical elastic compact in a
//          die, pressed from above
//            F_b = F_t exp(-4 mu_w K L / D)                force that reaches the bottom
//            mu  = F_l / F_b                               coefficient on the target
//          The thesis uses one coefficient for wall and target, mu_w = mu. Then, with
//          k = 4 K L / D and r = F_l / F_t, mu solves
//            mu exp(-k mu) = r                             mu = -W_0(-k r) / k
//          There are two solutions for k r < 1/e, of which the smaller is taken: it tends to
//          mu = r for a short compact. For k r > 1/e there is none: no coefficient could transmit that
//          much shear. With a wall coefficient given, mu = r exp(k mu_w).
// Symbols  F_t force on the punch, F_b on the target, F_l shear force (N); K radial over axial
//          stress, nu/(1 - nu) for an elastic compact;
//          L length and D diameter of the compact (m)
// Validity (3.1) assumes sliding along the whole wall and one K over the height
#pragma once

#include <optional>

namespace pulvis::lab {

// k
double wall_exponent(double stress_ratio, double length, double diameter);

// mu for mu_w = mu; empty where k r > 1/e. r < 0 gives a negative mu.
std::optional<double> friction_coefficient(double ratio, double exponent);

// The largest r that has a solution: 1/(e k).
double largest_ratio(double exponent);

}  // namespace pulvis::lab
