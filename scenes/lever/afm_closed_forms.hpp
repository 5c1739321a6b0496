// The formulas that a calibration stands beside, in SI units. h is the arm from the lever's middle plane
// to the tip's end.
//
// Source   beam: Euler-Bernoulli; torsion of a strip, K = (w t^3/16)(16/3 - 3.36 t/w); lateral bending of
//          the lever under a rigid tip, 4 L^3/(E t w^3) (force and its moment about the lever's length)
//          V: Neumeister & Ducker (1994), with Delta_1 integrated anew: 3N/(E t^3 tan a) [(c-2d)^2 +
//          d^2 (2 ln(c/d) - 1)], c = w/sin a; Noy et al. (1995); Sader (1995), parallel beams
// Symbols  L, w, t length, width, thickness, m; alpha half-angle; d set-back of the load from the apex
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/afm_scene.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct ClosedForm {
  std::string quantity;  // "k_n", "k_l"
  std::string id;        // "beam", of figures that have it in their names
  std::string name;      // "beam, 3EI/L^3"
  double value = 0;      // N/m
};

namespace closed_form {

double beam_normal(double e, double l, double w, double t);
double beam_torsion(double e, double nu, double l, double w, double t, double h);
double beam_lateral_bending(double e, double l, double w, double t);

struct V {
  double e, nu,
      length;  // Pa, -, m: of the arms, along the axis, from the clamp to the inner corner
  double w, t, alpha, d;
};
double neumeister_ducker_normal(const V& v);
double neumeister_ducker_torsion(const V& v, double h);
double noy_normal(double e, double w, double t, double l);
double noy_lateral(double normal, double nu, double alpha, double l, double h);
// b: width over both arms at the clamp.
double sader_parallel_beam(double e, double w, double t, double l, double b, double alpha);

}  // namespace closed_form

// Ids of those of a shape, each with the quantities that it gives.
struct ClosedFormId {
  std::string id;
  bool normal, lateral;
};
std::vector<ClosedFormId> closed_form_ids(LeverSpec::Shape shape);

// Those that fit the lever's shape; lateral ones only with a tip.
std::vector<ClosedForm> closed_forms(const Scene& scene);

}  // namespace pulvis
