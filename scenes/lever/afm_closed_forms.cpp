#include "scenes/lever/afm_closed_forms.hpp"
#include "scenes/spec/afm_scene.hpp"

#include <cmath>

#include "scenes/lever/mesh/lever_mesh.hpp"
#include "scenes/lever/mesh/tip_mesh.hpp"

namespace pulvis {
namespace closed_form {

double beam_normal(double e, double l, double w, double t) {
  return e * w * t * t * t / (4 * l * l * l);
}

double beam_torsion(double e, double nu, double l, double w, double t, double h) {
  const double g = e / (2 * (1 + nu));
  const double k = w * t * t * t / 16 * (16.0 / 3 - 3.36 * t / w);
  return g * k / (h * h * l);
}

double beam_lateral_bending(double e, double l, double w, double t) {
  return e * t * w * w * w / (4 * l * l * l);
}

double neumeister_ducker_normal(const V& v) {
  const double c = v.w / std::sin(v.alpha), cosine = std::cos(v.alpha), t3 = v.t * v.t * v.t;
  const double l = v.length, d = v.d;
  // The load at the very apex: d^2 ln d tends to 0.
  const double logarithm = d > 0 ? d * d * (2 * std::log(c / d) - 1) : 0;
  const double one = 3 / (v.e * t3 * std::tan(v.alpha)) * ((c - 2 * d) * (c - 2 * d) + logarithm);
  const double r = (l * std::tan(v.alpha) + (v.w - d * std::sin(v.alpha)) * (1 - v.nu) * cosine) /
                   (2 - (1 - v.nu) * cosine * cosine);
  const double two =
      l * l / (v.e * v.w * t3 * cosine * cosine) *
      (2 * l / cosine + 3 * (v.w / std::tan(v.alpha) - d * cosine - r * std::sin(v.alpha)));
  const double slope =
      3 * l * (1 + v.nu) / (v.e * v.w * t3 * cosine) * (c - d + r / std::tan(v.alpha));
  return 1 / (one + two + slope * (c - d));
}

double neumeister_ducker_torsion(const V& v, double h) {
  const double c = v.w / std::sin(v.alpha);
  return v.e * v.t * v.t * v.t / (3 * (1 + v.nu) * h * h) /
         (std::log(c / v.d) / std::tan(v.alpha) + v.length * std::cos(v.alpha) / v.w -
          0.375 * std::sin(2 * v.alpha));
}

double noy_normal(double e, double w, double t, double l) {
  return e * w * t * t * t / (2 * l * l * l);
}

double noy_lateral(double normal, double nu, double alpha, double l, double h) {
  const double c = std::cos(alpha), s = std::sin(alpha);
  return 2 / (6 * c * c + 3 * (1 + nu) * s * s) * (l / h) * (l / h) * normal;
}

double sader_parallel_beam(double e, double w, double t, double l, double b, double alpha) {
  const double ratio = w / b, c = std::cos(alpha);
  return e * t * t * t * w / (2 * l * l * l) * c / (1 + 4 * ratio * ratio * ratio * (3 * c - 2));
}

}  // namespace closed_form

namespace {

std::vector<ClosedForm> of_beam(const LeverSpec& lever, const MaterialSpec& m, double load_at,
                                double h) {
  const double e = m.youngs_modulus, nu = m.poissons_ratio, w = lever.width, t = lever.thickness;
  std::vector<ClosedForm> forms{
      {"k_n", "beam", "beam, 3EI/L^3", closed_form::beam_normal(e, load_at, w, t)}};
  if (h == 0) return forms;
  const double twist = closed_form::beam_torsion(e, nu, load_at, w, t, h);
  const double bend = closed_form::beam_lateral_bending(e, load_at, w, t);
  forms.push_back({"k_l", "torsion", "torsion alone, GK/(h^2 L)", twist});
  forms.push_back({"k_l", "torsion_and_bending", "torsion and lateral bending, rigid tip",
                   1 / (1 / twist + 1 / bend)});
  return forms;
}

std::vector<ClosedForm> of_v(const LeverSpec& lever, const TipSpec& tip, const MaterialSpec& m,
                             double h) {
  const VOutline o = v_outline(lever);
  const double e = m.youngs_modulus, nu = m.poissons_ratio, t = lever.thickness;
  const double w = lever.arm_width, load_at = lever.length - tip.set_back;
  const closed_form::V v{e, nu, o.inner, w, t, o.half_angle, o.apex - load_at};
  const double noy = closed_form::noy_normal(e, w, t, load_at);
  std::vector<ClosedForm> forms{
      {"k_n", "neumeister_ducker", "Neumeister & Ducker 1994, corrected",
       closed_form::neumeister_ducker_normal(v)},
      {"k_n", "noy", "Noy 1995", noy},
      {"k_n", "sader", "Sader 1995, parallel beams",
       closed_form::sader_parallel_beam(e, w, t, load_at, o.base_width, o.half_angle)}};
  if (h == 0) return forms;
  if (v.d > 0)
    forms.push_back({"k_l", "neumeister_ducker", "Neumeister & Ducker 1994, torsion alone",
                     closed_form::neumeister_ducker_torsion(v, h)});
  forms.push_back(
      {"k_l", "noy", "Noy 1995", closed_form::noy_lateral(noy, nu, o.half_angle, load_at, h)});
  return forms;
}

}  // namespace

std::vector<ClosedFormId> closed_form_ids(LeverSpec::Shape shape) {
  if (shape == LeverSpec::Shape::mesh) return {};  // of a drawing, which a mesh has not
  if (shape == LeverSpec::Shape::beam)
    return {{"beam", true, false}, {"torsion", false, true}, {"torsion_and_bending", false, true}};
  return {{"neumeister_ducker", true, true}, {"noy", true, true}, {"sader", true, false}};
}

std::vector<ClosedForm> closed_forms(const Scene& scene) {
  const LeverSpec& lever = scene.afm->lever;
  const TipSpec& tip = scene.afm->tip;
  const MaterialSpec& m = scene.materials[static_cast<std::size_t>(lever.material)];
  const double h = tip.shape == TipSpec::Shape::none ? 0 : tip_height(tip) + 0.5 * lever.thickness;
  if (lever.shape == LeverSpec::Shape::mesh) return {};
  return lever.shape == LeverSpec::Shape::beam ? of_beam(lever, m, lever.length - tip.set_back, h)
                                               : of_v(lever, tip, m, h);
}

}  // namespace pulvis
