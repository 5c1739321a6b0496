// Yield surfaces of powders, fitted to yield points: what continuum codes take, and what theories of powders say.
//
// p: pressure, q: von Mises' stress, both Pa. A surface is what bounds the stresses that a model calls elastic.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scenes/probe/yield_points.hpp"

namespace pulvis {

inline constexpr double cap_transition = 0.03;  // -, alpha of the Drucker-Prager cap

struct FittedModel {
  std::string name;
  std::vector<std::pair<std::string, double>> parameters;  // Pa, rad or -
  bool in_plane = false;  // of the pressure and shear in the plane instead of p and q
  double misfit = 0;      // rms of the distance to the points along rays, over the largest pressure
  std::vector<std::pair<double, double>> surface;  // Pa, p and q >= 0 along it, for pictures
  double parameter(const std::string& of) const;
};

// Of the points whose pressure in the plane is above a tenth of the largest: where the powder comes apart, what is left is the
// stress zz that plane strain locks into the particles, and no surface. And of those with q > 0, pressed more in y: what was
// pressed in y has another surface on the other side, which no isotropic model can have.
//   drucker_prager_cap      d, beta, R, p_b (cap on the p axis), alpha (transition), p_a: Abaqus, *CAP PLASTICITY
//   modified_cam_clay       M, p_c
//   fleck_kuhn_mcmeeking    p_y: spheres, isotropic, stage I (Fleck, Kuhn & McMeeking 1992, in the form of Redanz,
//                           Fleck & McMeeking)
//   gurson                  sigma_y, f = 1 - density (Gurson 1977)
//   fleck_plane, fleck_plane_cohesive   p_y: cylinders, isotropic, frictionless contacts of a constant pressure that bear
//                           no tension, or as much as compression: Fleck 1995 in two dimensions (docs/theory.md)
// Fewer than five points: none.
// Without bonds the stress 0 is one more point of the cap: nothing holds the powder together.
std::vector<FittedModel> fit_caps(const std::vector<YieldPoint>& points, double relative_density,
                                  bool bonded);

// Whether the model with these parameters calls p, q elastic: what a fit, and whoever reads its parameters back, goes by.
bool is_elastic(const std::string& model,
                const std::vector<std::pair<std::string, double>>& parameters, double p, double q);

}  // namespace pulvis
