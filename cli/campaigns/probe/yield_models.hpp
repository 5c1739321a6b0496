// Yield surfaces of powders: those used by continuum codes, and those of powder theories (docs/theory.md).
//
// A surface bounds the stresses that a model treats as elastic.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "cli/campaigns/probe/mandel.hpp"

namespace pulvis {

inline constexpr double cap_transition = 0.03;  // -, alpha of the Drucker-Prager cap

struct YieldModel {
  // What the model is in terms of. Its stresses are Mandel vectors of which the first two have only two components.
  enum class Terms {
    invariants,  // pressure p and von Mises stress q
    plane,       // pressure and shear in the plane, in two dimensions
    stress       // all components
  };
  std::string name;
  std::vector<std::string> parameters;
  Terms terms = Terms::invariants;
  // Initial parameters, all > 0; from the largest pressure and shear. The best fit is taken.
  std::function<std::vector<Eigen::VectorXd>(double p, double q)> starts;
  std::function<bool(const Eigen::VectorXd& x, const Mandel& at)> elastic;
};

// The powder to which models are fitted.
struct ProbedPowder {
  Axis axis = Axis::y;
  double relative_density = 1;
  bool bonded = false;
  Mandel loaded = Mandel::Zero();  // Pa, the stress that it was loaded to
  Mandel centre = Mandel::Zero();  // Pa, unloaded: where the probes begin, inside the surface
};

//   drucker_prager_cap      d, beta, R, p_b (cap on the p axis), alpha (transition), p_a: Abaqus, *CAP PLASTICITY
//   modified_cam_clay       M, p_c
//   s_clay                  M, p_c, alpha, with bonds also p_t: Cam-Clay turned by alpha towards the deviator of `loaded`, and
//                           moved by the tensile strength p_t (Wheeler et al. 2003; Dafalias 1986)
//   fleck_kuhn_mcmeeking    p_y: spheres, isotropic, stage I (Fleck, Kuhn & McMeeking 1992, in the form of Redanz,
//                           Fleck & McMeeking)
//   gurson                  sigma_y, f = 1 - density (Gurson 1977)
//   fleck_plane, fleck_plane_cohesive   p_y: cylinders, isotropic, frictionless contacts of constant pressure that carry
//                           no tension, or as much as compression: Fleck 1995 in two dimensions
std::vector<YieldModel> yield_models(const ProbedPowder& powder);

}  // namespace pulvis
