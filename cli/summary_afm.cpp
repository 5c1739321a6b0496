#include "cli/summary_afm.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/instruction_set.hpp"
#include "scenes/language/counted.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json response_json(const UnitResponse& r) {
  return {{"tip_displacement", vector_json(r.end)},
          {"foot_displacement", vector_json(r.foot)},
          {"slope_normal", r.spot.normal},
          {"slope_lateral", r.spot.lateral},
          {"foot_slope_normal", r.at_foot.normal},
          {"foot_slope_lateral", r.at_foot.lateral},
          {"clamp_force", vector_json(r.clamp_force)},
          {"clamp_moment", vector_json(r.clamp_moment)}};
}

double finite_element(const Calibration& c, const std::string& quantity) {
  return quantity == "k_n" ? c.normal_stiffness : c.lateral_stiffness;
}

Json calibration_json(const Calibration& c) {
  Json json{{"k_n", c.normal_stiffness},
            {"k_l", c.lateral_stiffness},
            {"k_x", c.longitudinal_stiffness},
            {"torsional_stiffness", c.torsional_stiffness},
            {"arm", c.arm},
            {"share_bending", c.bending_share},
            {"share_twist", c.twist_share},
            {"share_tip", c.tip_share},
            {"invols_normal", c.normal_invols},
            {"imbalance", c.imbalance},
            {"error", c.error},
            {"precision", c.extended ? "long double" : "double"}};
  if (c.mesh_error)
    json["mesh_error"] = {{"k_n", c.mesh_error->normal},
                          {"k_l", c.mesh_error->lateral},
                          {"k_x", c.mesh_error->longitudinal}};
  if (std::isfinite(c.lateral_invols)) json["invols_lateral"] = c.lateral_invols;
  json["per_newton"] = {{"normal", response_json(c.normal)},
                        {"lateral", response_json(c.lateral)},
                        {"longitudinal", response_json(c.longitudinal)}};
  for (const ClosedForm& form : c.closed_forms) {
    Json entry{{"quantity", form.quantity}, {"name", form.name}, {"value", form.value}};
    if (form.not_for.empty())
      entry["difference"] = finite_element(c, form.quantity) / form.value - 1;
    else
      entry["does_not_apply"] = form.not_for;
    json["closed_forms"].push_back(std::move(entry));
  }
  return json;
}

Json loop_json(const FrictionLoop& loop) {
  Json json{{"action", loop.action},
            {"load", loop.load},
            {"touches", loop.touches},
            {"slides", loop.slides},
            {"turned", loop.turned},
            {"drift", loop.drift},
            {"settled", loop.full()},
            {"trace", loop.trace},
            {"retrace", loop.retrace},
            {"half_width", loop.half_width},
            {"offset", loop.offset},
            {"volts_half_width", loop.volts_half_width},
            {"volts_offset", loop.volts_offset}};
  if (loop.needed > 0) json["needed_distance"] = loop.needed;
  if (loop.friction) json["friction"] = *loop.friction;
  if (loop.other_root) json["other_root"] = *loop.other_root;
  if (loop.sensitivity) json["sensitivity"] = *loop.sensitivity;
  return json;
}

std::string closed_form_text(const Calibration& c, const std::string& quantity) {
  std::string text;
  for (const ClosedForm& form : c.closed_forms) {
    if (form.quantity != quantity) continue;
    text += fmt::format("  {:<42} {:.5g} N/m, ", form.name, form.value);
    text += form.not_for.empty() ? fmt::format("finite elements {:+.2f}%\n",
                                               100 * (finite_element(c, quantity) / form.value - 1))
                                 : fmt::format("does not apply: {}\n", form.not_for);
  }
  return text;
}

Json curve_json(const ForceCurveFigures& curve) {
  Json json{{"action", curve.action},
            {"greatest_force", curve.greatest},
            {"pull_off", curve.pull_off},
            {"work", curve.work}};
  if (curve.work_of_adhesion) json["work_of_adhesion"] = *curve.work_of_adhesion;
  return json;
}

std::string invols_text(double invols) {
  return std::isfinite(invols) ? fmt::format("{:.4g} m/V", invols)
                               : "none, the detector's gain is 0";
}

const char* without_wedge(const FrictionLoop& loop) {
  if (loop.load <= 0) return "the load is not above 0";
  if (loop.volts_half_width == 0) return "the detector shows no friction, its gain is 0";
  return "no coefficient of friction fits W and Delta";
}

std::string unsettled_text(const FrictionLoop& loop) {
  std::string text =
      "  W is not caused by friction alone: in the half of the traverse where it is evaluated ";
  if (loop.touches < 1)
    return text + fmt::format("the probe is off the sample {:.0f}% of the time\n",
                              100 * (1 - loop.touches));
  if (loop.slides <= 1 - 1e-3)
    text += fmt::format("the probe sticks {:.0f}% of the time", 100 * (1 - loop.slides));
  else if (loop.turned <= 1 - 1e-3)
    text += fmt::format(
        "only {:.1f}% of the friction acts along the scan, the rest still as the press left it",
        100 * loop.turned);
  else
    text += fmt::format("the force drifts by {:.1f}% of W", 100 * loop.drift);
  return text + (loop.needed > 0 ? fmt::format(": a scan of {:.2g} m is needed\n", loop.needed)
                                 : ": a longer scan, or a scan at constant force, is needed\n");
}

}  // namespace

std::string afm_summary(const LoadedScene& loaded, const AfmReport& report) {
  Json json{{"title", loaded.scene.title},
            {"family", "afm"},
            {"outcome", report.outcome},
            {"version", program_version()},
            {"commit", program_commit()},
            {"scene_hash", fmt::format("{:016x}", loaded.hash)},
            {"threads", report.threads},
            {"instruction_set", instruction_set()},
            {"wall_seconds", report.wall_seconds},
            {"elements", report.elements},
            {"nodes", report.nodes},
            {"increments", report.increments},
            {"state_hash", report.state_hash}};
  if (report.calibration) json["calibration"] = calibration_json(*report.calibration);
  for (const FrictionLoop& loop : report.loops) json["loops"].push_back(loop_json(loop));
  for (const ForceCurveFigures& curve : report.curves)
    json["force_curves"].push_back(curve_json(curve));
  for (const auto& [name, value] : report.figures)
    if (std::isfinite(value)) json["values"][name] = value;
  if (report.wedge)
    json["wedge"] = {{"loops", report.loops.size()},
                     {"friction", report.wedge->friction.value},
                     {"sensitivity", report.wedge->sensitivity.value}};
  for (const Verdict& verdict : report.verdicts) {
    Json entry{{"what", verdict.what},
               {"measured", verdict.measured},
               {"expected", verdict.allowed},
               {"met", verdict.met}};
    if (verdict.value) entry["value"] = *verdict.value;
    json["expectations"].push_back(entry);
  }
  if (!report.warnings.empty()) json["warnings"] = report.warnings;
  return json.dump(2) + "\n";
}

std::string curve_text(const ForceCurveFigures& curve) {
  if (!curve.released)
    return fmt::format(
        "force curve, retracting from action {}: still in contact at the end, no pull-off\n",
        curve.action);
  std::string text =
      fmt::format("force curve, retracting from action {}: pull-off {:.5g} N, work {:.4g} J",
                  curve.action, curve.pull_off, curve.work);
  if (curve.work_of_adhesion)
    text += fmt::format(", work of adhesion {:.4g} J/m^2", *curve.work_of_adhesion);
  return text + "\n";
}

std::string loop_text(const FrictionLoop& loop) {
  if (loop.touches == 0)
    return fmt::format(
        "friction loop of action {}: the probe does not touch the sample where W is evaluated\n",
        loop.action);
  std::string text =
      fmt::format("friction loop of action {}: load {:.5g} N, W {:.5g} N, Delta {:.5g} N",
                  loop.action, loop.load, loop.half_width, loop.offset);
  if (loop.load > 0)
    text += fmt::format("; W/L {:.5f}, Delta/L {:.5f}", loop.half_width / loop.load,
                        loop.offset / loop.load);
  text += "\n";
  if (!loop.full()) text += unsettled_text(loop);
  if (loop.on_slope && loop.full() && !loop.friction)
    text += fmt::format("  no wedge calibration: {}\n", without_wedge(loop));
  if (loop.friction)
    text += fmt::format("  wedge calibration of the detector: friction {:.5f}, {:.5g} N/V\n",
                        *loop.friction, *loop.sensitivity);
  if (loop.other_root)
    text += fmt::format(
        "  the volts also fit a friction of {:.5f}, with which W would not be {:.5g} N\n",
        *loop.other_root, loop.half_width);
  return text;
}

std::string wedge_summary(const wedge::Calibration& c) {
  const wedge::Facet& facet = c.facets.front();
  return fmt::format("wedge calibration over {} at {}: friction {:.5f}, {:.5g} N/V\n",
                     counted(facet.loops, "loop"), counted(facet.loads, "load"), c.friction.value,
                     c.sensitivity.value);
}

std::string calibration_text(const Calibration& c) {
  std::string text = fmt::format("normal stiffness    k_n {:.5g} N/m\n", c.normal_stiffness);
  text += closed_form_text(c, "k_n");
  text +=
      fmt::format("lateral stiffness   k_l {:.5g} N/m (arm h {:.4g} um from the middle plane)\n",
                  c.lateral_stiffness, c.arm * 1e6);
  text += closed_form_text(c, "k_l");
  text += fmt::format("torsional stiffness {:.5g} N m/rad; along the lever {:.5g} N/m\n",
                      c.torsional_stiffness, c.longitudinal_stiffness);
  text += fmt::format(
      "lateral displacement of the tip's end: {:.1f}% twist, {:.1f}% lateral bending, "
      "{:.1f}% in the tip\n",
      100 * c.twist_share, 100 * c.bending_share, 100 * c.tip_share);
  if (c.mesh_error)
    text += fmt::format("the mesh makes them too stiff by about {:.1f}% (k_n) and {:.1f}% (k_l)\n",
                        100 * c.mesh_error->normal, 100 * c.mesh_error->lateral);
  return text + fmt::format("InvOLS normal {}, lateral {}\n", invols_text(c.normal_invols),
                            invols_text(c.lateral_invols));
}

}  // namespace pulvis
