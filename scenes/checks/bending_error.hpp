// The bending error of a slender body with few elements across it.
//
// Law      of n equal rows of quads, r = element length (along the body) over height, against the beam:
//            four-point  ((4/3 + r^2) (1 - nu)/2 - 1)/n^2
//            standard    ((1 - nu)^2/(1 - 2 nu) - 1 + r^2 (1 - nu)/2)/n^2
//            one-point   none: it bends like a fibre (systems/body/hourglass_kernel.hpp)
//          A quad in bending keeps its sides straight: its shear strain is r times the fibre's, hence r^2.
//          The mean dilatation removes pressure from bending, which leaves a fibre the modulus 4/3 mu
//          instead of E'. Verified against runs in tests/physics/bending_test.cpp
// Valid    small strains, rows across a rectangle or layers of a ring
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// -, relative error of the bending stiffness: > 0, too stiff. None unless a slender rectangle or ring.
std::optional<double> bending_error(const Scene& scene, const ParticleSpec& particle);

// One line for each particle class whose bending stiffness is wrong by more than 10 %.
std::vector<std::string> bending_warnings(const Scene& scene);

}  // namespace pulvis
