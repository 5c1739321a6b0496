// How wrong elements bend that are few across a slender body.
//
// Law      of n equal rows of quads, r = their length along the body over their height, against the beam:
//            four-point  ((4/3 + r^2) (1 - nu)/2 - 1)/n^2
//            standard    ((1 - nu)^2/(1 - 2 nu) - 1 + r^2 (1 - nu)/2)/n^2
//            one-point   nothing: its bending is that of a fibre (systems/body/hourglass_kernel.hpp)
//          A quad that bends keeps its sides straight, which is a shear strain of r times the fibre's: r^2.
//          The mean dilatation takes the pressure out of bending, which leaves a fibre the modulus 4/3 mu
//          instead of E'. Held to runs in tests/physics/bending_test.cpp
// Valid    small strains, rows across a rectangle or layers of a ring
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// -, of the bending stiffness: > 0, too stiff. None for particles that are no slender rectangles or rings.
std::optional<double> bending_error(const Scene& scene, const ParticleSpec& particle);

// One line for each particle class whose bending is off by more than a tenth.
std::vector<std::string> bending_warnings(const Scene& scene);

}  // namespace pulvis
