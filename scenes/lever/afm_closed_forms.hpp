// The formulas that a calibration is compared with, in SI units. h is the arm from the lever's middle plane
// to the tip's end.
//
// Source   beam: Euler-Bernoulli; torsion of a strip, K = (w t^3/16)(16/3 - 3.36 t/w); lateral bending of
//          the lever under a rigid tip, 4 L^3/(E t w^3) (force and its moment about the lever's length)
//          V: Neumeister & Ducker (1994), with Delta_1 integrated again: 3N/(E t^3 tan a) [(c-2d)^2 +
//          d^2 (2 ln(c/d) - 1)], c = w/sin a; Noy et al. (1995); Sader (1995), parallel beams
//          coated: as a composite strip, classical laminate theory (Jones 1999, sec. 4.2): stretching and bending
//          about the axis where axial forces balance, twisting about that of the shear forces
//          tilted by a, tip of height h, offset e from the beam axis: 1/k_n = [L^3/3 cos^2 a - L^2 h sin a cos a
//          + L h^2 sin^2 a]/(E I) + e^2 L/(G K) cos^2 a, from the beam's response to a force and a moment at its
//          end (Heim, Kappl & Butt 2004 without e)
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
  std::string id;        // "beam", for figures that have it in their names
  std::string name;      // "beam, 3EI/L^3"
  double value = 0;      // N/m
  std::string not_for;   // why it does not apply to this lever; empty: it applies
};

namespace closed_form {

// A strip of one layer, or of two with a coating on its back.
struct Layer {
  double e, nu, t;  // Pa, -, m
};
struct Strip {
  double w = 0, t = 0;    // m, including the coating
  double bending = 0;     // N m^2, E I
  double sideways = 0;    // N m^2, E I in its plane
  double torsion = 0;     // N m^2, G K
  double twist_axis = 0;  // m, above the middle of the first layer
};
Strip strip_of(double w, const std::vector<Layer>& layers);

struct Load {
  double l = 0, h = 0;     // m, from the clamp; from the strip's middle down to the tip's end
  double tilt = 0, e = 0;  // rad; m, offset from the axis
};
double beam_normal(const Strip& strip, const Load& load);
double beam_torsion(const Strip& strip, const Load& load);
double beam_lateral_bending(const Strip& strip, const Load& load);

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

// Ids of the closed forms for a shape, each with the quantities that it gives.
struct ClosedFormId {
  std::string id;
  bool normal, lateral;
};
std::vector<ClosedFormId> closed_form_ids(LeverSpec::Shape shape);

// The closed forms for the lever's shape; lateral ones only with a tip.
std::vector<ClosedForm> closed_forms(const Scene& scene);

}  // namespace pulvis
