#include "scenes/lever/afm_closed_forms.hpp"
#include "scenes/spec/afm_scene.hpp"

#include <cmath>
#include <utility>

#include "engine/portable_math.hpp"
#include "scenes/lever/mesh/lever_mesh.hpp"
#include "scenes/lever/mesh/tip_mesh.hpp"

namespace pulvis {
namespace closed_form {

Strip strip_of(double w, const std::vector<Layer>& layers) {
  const double middle = 0.5 * layers.front().t;
  const auto shear = [](const Layer& layer) { return layer.e / (2 * (1 + layer.nu)); };
  // Second moment about the axis where the forces of a linear strain distribution balance.
  const auto moment = [&](const auto& modulus) {
    double sum = 0, first = 0, z = -middle;
    for (const Layer& layer : layers) {
      sum += modulus(layer) * layer.t;
      first += modulus(layer) * layer.t * (z + 0.5 * layer.t);
      z += layer.t;
    }
    const double axis = first / sum;
    double second = 0;
    z = -middle;
    for (const Layer& layer : layers) {
      const double off = z + 0.5 * layer.t - axis;
      second += modulus(layer) * layer.t * (layer.t * layer.t / 12 + off * off);
      z += layer.t;
    }
    return std::pair{second, axis};
  };
  Strip strip{w};
  for (const Layer& layer : layers) {
    strip.t += layer.t;
    strip.sideways += layer.e * layer.t * w * w * w / 12;
  }
  strip.bending = w * moment([](const Layer& layer) { return layer.e; }).first;
  const auto [twisting, axis] = moment(shear);
  // For a uniform strip G w t^3 (1/3 - 0.21 t/w).
  strip.torsion = 4 * w * twisting * (1 - 0.63 * strip.t / w);
  strip.twist_axis = axis;
  return strip;
}

double beam_normal(const Strip& strip, const Load& load) {
  const double c = portable::cos(load.tilt), s = portable::sin(load.tilt), l = load.l, h = load.h;
  const double bent = l * l * l / 3 * c * c - l * l * h * s * c + l * h * h * s * s;
  return 1 / (bent / strip.bending + load.e * load.e * l / strip.torsion * c * c);
}

double beam_torsion(const Strip& strip, const Load& load) {
  const double arm = load.h + strip.twist_axis;
  return strip.torsion / (arm * arm * load.l);
}

double beam_lateral_bending(const Strip& strip, const Load& load) {
  return 3 * strip.sideways / (load.l * load.l * load.l);
}

double neumeister_ducker_normal(const V& v) {
  const double c = v.w / std::sin(v.alpha), cosine = std::cos(v.alpha), t3 = v.t * v.t * v.t;
  const double l = v.length, d = v.d;
  // Load exactly at the apex: d^2 ln d tends to 0.
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

closed_form::Strip strip_of(const Scene& scene, double w) {
  const LeverSpec& lever = scene.afm->lever;
  const auto layer = [&](int material, double t) {
    const MaterialSpec& m = scene.materials[static_cast<std::size_t>(material)];
    return closed_form::Layer{m.youngs_modulus, m.poissons_ratio, t};
  };
  std::vector<closed_form::Layer> layers{layer(lever.material, lever.thickness)};
  if (lever.coating) layers.push_back(layer(*lever.coating, lever.coating_thickness));
  return closed_form::strip_of(w, layers);
}

// Distance of the tip's end below the lever's middle plane; 0 without a tip.
double height_below(const AfmScene& afm) {
  return afm.tip.shape == TipSpec::Shape::none ? 0
                                               : tip_height(afm.tip) + 0.5 * afm.lever.thickness;
}

std::vector<ClosedForm> of_beam(const Scene& scene) {
  const AfmScene& afm = *scene.afm;
  const closed_form::Strip strip = strip_of(scene, afm.lever.width);
  const double h = height_below(afm);
  const closed_form::Load load{afm.lever.length - afm.tip.set_back,
                               h > 0 ? h : 0.5 * afm.lever.thickness, afm.lever.tilt,
                               afm.tip.offset};
  const char* coated = afm.lever.coating ? ", composite" : "";
  std::vector<ClosedForm> forms{
      {"k_n",
       "beam",
       std::string(load.tilt == 0 && load.e == 0 ? "beam, 3EI/L^3" : "beam, tilt and offset") +
           coated,
       closed_form::beam_normal(strip, load),
       {}}};
  if (h == 0) return forms;
  const double twist = closed_form::beam_torsion(strip, load);
  const double bend = closed_form::beam_lateral_bending(strip, load);
  forms.push_back({"k_l", "torsion", std::string("torsion alone, GK/(h^2 L)") + coated, twist, {}});
  forms.push_back({"k_l",
                   "torsion_and_bending",
                   std::string("torsion and lateral bending, rigid tip") + coated,
                   1 / (1 / twist + 1 / bend),
                   {}});
  return forms;
}

// For a V the normal stiffness ignores tilt and offset; a coating is treated as a plate that is correspondingly
// stiffer in bending, or in torsion.
std::vector<ClosedForm> of_v(const Scene& scene) {
  const LeverSpec& lever = scene.afm->lever;
  const TipSpec& tip = scene.afm->tip;
  const MaterialSpec& m = scene.materials[static_cast<std::size_t>(lever.material)];
  const VOutline o = v_outline(lever);
  const double e = m.youngs_modulus, nu = m.poissons_ratio, t = lever.thickness;
  const double w = lever.arm_width, load_at = lever.length - tip.set_back;
  const closed_form::V v{e, nu, o.inner, w, t, o.half_angle, o.apex - load_at};
  const closed_form::Strip coated = strip_of(scene, w);
  const closed_form::Strip bare = closed_form::strip_of(w, {{e, nu, t}});
  const double bending = coated.bending / bare.bending;
  // For wide plates: without the reduction due to the strip's edges.
  const double torsion =
      coated.torsion / (1 - 0.63 * coated.t / w) / (bare.torsion / (1 - 0.63 * bare.t / w));
  const char* composite = lever.coating ? ", composite" : "";
  const auto named = [&](const char* name) { return std::string(name) + composite; };
  const double noy = bending * closed_form::noy_normal(e, w, t, load_at);
  const std::string not_tilted = lever.tilt != 0   ? "the lever is tilted"
                                 : tip.offset != 0 ? "the tip is off the axis"
                                                   : "";
  std::vector<ClosedForm> forms{
      {"k_n", "neumeister_ducker", named("Neumeister & Ducker 1994, corrected"),
       bending * closed_form::neumeister_ducker_normal(v), not_tilted},
      {"k_n", "noy", named("Noy 1995"), noy, not_tilted},
      {"k_n", "sader", named("Sader 1995, parallel beams"),
       bending * closed_form::sader_parallel_beam(e, w, t, load_at, o.base_width, o.half_angle),
       not_tilted}};
  if (height_below(*scene.afm) == 0) return forms;
  const double h = height_below(*scene.afm) + coated.twist_axis;
  const std::string not_beside = tip.offset != 0 ? "the tip is off the axis" : "";
  if (v.d > 0)
    forms.push_back({"k_l", "neumeister_ducker", named("Neumeister & Ducker 1994, torsion alone"),
                     torsion * closed_form::neumeister_ducker_torsion(v, h), not_beside});
  forms.push_back({"k_l", "noy", named("Noy 1995"),
                   closed_form::noy_lateral(noy, nu, o.half_angle, load_at, h), not_beside});
  return forms;
}

}  // namespace

std::vector<ClosedFormId> closed_form_ids(LeverSpec::Shape shape) {
  if (shape == LeverSpec::Shape::mesh) return {};  // these need a drawing, not a mesh
  if (shape == LeverSpec::Shape::beam)
    return {{"beam", true, false}, {"torsion", false, true}, {"torsion_and_bending", false, true}};
  return {{"neumeister_ducker", true, true}, {"noy", true, true}, {"sader", true, false}};
}

std::vector<ClosedForm> closed_forms(const Scene& scene) {
  using Shape = LeverSpec::Shape;
  if (scene.afm->lever.shape == Shape::mesh) return {};  // these need a drawing, not a mesh
  return scene.afm->lever.shape == Shape::beam ? of_beam(scene) : of_v(scene);
}

}  // namespace pulvis
