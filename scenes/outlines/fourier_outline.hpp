// The radius of an irregular outline as a function of its polar angle, before stretching:
//   r(t)/r0 = 1 + sum of D_n cos(n t + phase_n),
//   D_n = irregularity (n/3)^-decay, n = 3 .. 7,  D_n = roughness (n/8)^-decay, n = 8 .. modes.
// These are the descriptors D3 and D8 with their decays of Mollon and Zhao, Granular Matter 14 (2012) 621; their D2,
// the elongation, is a stretch here, since a mode 2 with an aspect ratio above 1.5 has a waist.
#pragma once

#include <vector>

#include "scenes/outlines/portable.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Modes 3 .. 7 with amplitudes for irregularity 1, the others for roughness 1.
struct FourierModes {
  struct Mode {
    int n;
    double cosine, sine;  // of the unit amplitude, with the random phase
  };
  std::vector<Mode> irregular, rough;
};
FourierModes fourier_modes(const FourierOutline& outline);

// A sum of modes and its derivative by the angle, at the angle with this cosine and sine.
struct FourierSum {
  double value = 0, slope = 0;
};
FourierSum sum_at(const std::vector<FourierModes::Mode>& modes, portable::Turn angle);

}  // namespace pulvis
