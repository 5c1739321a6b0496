// Yield surfaces of powders, fitted to yield points: those used by continuum codes, and those of powder theories.
//
// p: pressure, q: von Mises stress, both Pa. A surface bounds the stresses that a model treats as elastic.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/campaigns/probe/yield_points.hpp"

namespace pulvis {

inline constexpr double cap_transition = 0.03;  // -, alpha of the Drucker-Prager cap

// The values of a parameter with which the model fits as well, with a confidence of 95%, when its other parameters follow.
struct ParameterRange {
  std::string name;
  double
      low = 0,
      high =
          0;  // 0, infinity: no bound within a factor of 10, of d up to the largest p; beta: pi/2
  bool determined =
      true;  // the range is no wider than the value itself, or for d than a tenth of p_b
};

struct FittedModel {
  std::string name;
  std::vector<std::pair<std::string, double>> parameters;  // Pa, rad or -
  bool in_plane = false;  // in terms of in-plane pressure and shear instead of p and q
  std::vector<ParameterRange>
      ranges;         // of the fitted parameters, not of those that follow from them
  double misfit = 0;  // rms distance to the points along rays, over the largest pressure
  std::vector<std::pair<double, double>> surface;  // Pa, p and q >= 0 along it, for plotting
  double parameter(const std::string& of) const;
};

// Only points whose in-plane pressure is above a tenth of the largest: where the powder comes apart, what remains is the
// stress zz that plane strain locks into the particles, not a surface. And only q > 0, compressed more in y: a powder
// compressed in y has a different surface on the other side, which no isotropic model can represent.
//   drucker_prager_cap      d, beta, R, p_b (cap on the p axis), alpha (transition), p_a: Abaqus, *CAP PLASTICITY
//   modified_cam_clay       M, p_c
//   fleck_kuhn_mcmeeking    p_y: spheres, isotropic, stage I (Fleck, Kuhn & McMeeking 1992, in the form of Redanz,
//                           Fleck & McMeeking)
//   gurson                  sigma_y, f = 1 - density (Gurson 1977)
//   fleck_plane, fleck_plane_cohesive   p_y: cylinders, isotropic, frictionless contacts of constant pressure that carry
//                           no tension, or as much as compression: Fleck 1995 in two dimensions (docs/theory.md)
// Fewer than five points: no models.
// Without bonds zero stress is an additional point of the cap: nothing holds the powder together.
std::vector<FittedModel> fit_caps(const std::vector<YieldPoint>& points, double relative_density,
                                  bool bonded);

// Of the parameters that the points do not determine, with their ranges: "beta (50 to 90 deg), R (0.2 to 2.1)". Empty: none.
std::string undetermined(const FittedModel& model);

// Which of the points are used by these fits.
std::vector<bool> usable(const std::vector<YieldPoint>& points);

// How many of the points are used by these fits, and how many they need.
std::size_t usable_points(const std::vector<YieldPoint>& points);
inline constexpr std::size_t fewest_points = 5;

// Whether the model with these parameters is elastic at p, q: used by the fit and by whoever reads its parameters back.
bool is_elastic(const std::string& model,
                const std::vector<std::pair<std::string, double>>& parameters, double p, double q);

}  // namespace pulvis
