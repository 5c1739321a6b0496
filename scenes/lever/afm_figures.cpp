#include "scenes/lever/afm_figures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scenes/lever/afm_calibration.hpp"
#include "scenes/lever/afm_curve.hpp"
#include "scenes/lever/afm_loop.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

struct Figure {
  SeriesInfo info;
  double (*of)(const Calibration&);
};
struct CurveFigure {
  SeriesInfo info;
  double (*of)(const ForceCurveFigures&);
};
struct LoopFigure {
  SeriesInfo info;
  double (*of)(const FrictionLoop&);
};

const std::vector<Figure>& calibration_figures() {
  using C = const Calibration&;
  static const std::vector<Figure> all{
      {{"k_n", "N/m", "normal stiffness $k_n$",
        "vertical force on the tip's end over its displacement"},
       [](C c) { return c.normal_stiffness; }},
      {{"k_l", "N/m", "lateral stiffness $k_l$",
        "lateral force on the tip's end over its displacement"},
       [](C c) { return c.lateral_stiffness; }},
      {{"k_l/k_n", "-", "lateral over normal stiffness $k_l/k_n$", "lateral over normal stiffness"},
       [](C c) { return c.lateral_stiffness / c.normal_stiffness; }},
      {{"arm", "m", "arm of the tip $h$", "h: distance from the middle plane to the tip's end"},
       [](C c) { return c.arm; }},
      {{"k_x", "N/m", "longitudinal stiffness $k_x$",
        "longitudinal force on the tip's end over its displacement"},
       [](C c) { return c.longitudinal_stiffness; }},
      {{"torsional_stiffness", "N m/rad", "torsional stiffness $k_\\varphi$",
        "moment of a lateral force over the twist of the foot"},
       [](C c) { return c.torsional_stiffness; }},
      {{"share_bending", "-", "share of lateral bending",
        "share of lateral bending in the tip's lateral displacement"},
       [](C c) { return c.bending_share; }},
      {{"share_twist", "-", "share of twist",
        "share of the foot's twist in the tip's lateral displacement"},
       [](C c) { return c.twist_share; }},
      {{"share_tip", "-", "share of the tip",
        "share of the tip's own deformation in its lateral displacement"},
       [](C c) { return c.tip_share; }},
      {{"slope_normal", "rad/m", "normal slope over displacement $\\theta$",
        "at the laser spot, per vertical displacement of the tip"},
       [](C c) { return c.normal.spot.normal / c.normal.end.z(); }},
      {{"slope_lateral", "rad/m", "lateral slope over displacement $\\varphi$",
        "at the laser spot, per lateral displacement of the tip"},
       [](C c) { return c.lateral.spot.lateral / c.lateral.end.y(); }},
      {{"invols_normal", "m/V", "normal InvOLS",
        "vertical displacement of the tip per detector signal"},
       [](C c) { return c.normal_invols; }},
      {{"invols_lateral", "m/V", "lateral InvOLS",
        "lateral displacement of the tip per detector signal"},
       [](C c) { return c.lateral_invols; }},
      {{"imbalance", "-", "imbalance of the calibration",
        "sum of clamp reaction and load, over the load"},
       [](C c) { return c.imbalance; }}};
  return all;
}

const std::vector<LoopFigure>& loop_figures() {
  using L = const FrictionLoop&;
  static const std::vector<LoopFigure> all{
      {{"loop/load", "N", "load of the loop $N$", "mean vertical force"},
       [](L l) { return l.load; }},
      {{"loop/slides", "-", "sliding share of the loop",
        "share of the contact points that slide where W is evaluated"},
       [](L l) { return l.slides; }},
      {{"loop/turned", "-", "share of friction along the scan",
        "share of the friction there that acts along the scan"},
       [](L l) { return l.turned; }},
      {{"loop/drift", "-", "drift of the plateaus", "drift of the force there, over W"},
       [](L l) { return l.drift; }},
      {{"loop/trace", "N", "force of the trace $F$",
        "mean force that drags the probe along the trace"},
       [](L l) { return l.trace; }},
      {{"loop/retrace", "N", "force of the retrace $F$",
        "mean force that drags the probe along the retrace"},
       [](L l) { return l.retrace; }},
      {{"loop/half_width", "N", "half-width of the loop $W$", "W"},
       [](L l) { return l.half_width; }},
      {{"loop/offset", "N", "offset of the loop $\\Delta$", "Delta"}, [](L l) { return l.offset; }},
      {{"loop/volts_half_width", "V", "half-width of the loop, signal $U$",
        "W of the lateral detector"},
       [](L l) { return l.volts_half_width; }},
      {{"loop/volts_offset", "V", "offset of the loop, signal $U$",
        "Delta of the lateral detector"},
       [](L l) { return l.volts_offset; }},
      {{"loop/friction", "-", "friction coefficient of the loop $\\mu$",
        "determined from the detector's W and Delta on an incline"},
       [](L l) { return l.friction.value_or(std::nan("")); }},
      {{"loop/sensitivity", "N/V", "sensitivity", "determined together with it"},
       [](L l) { return l.sensitivity.value_or(std::nan("")); }}};
  return all;
}

const std::vector<CurveFigure>& curve_figures() {
  using C = const ForceCurveFigures&;
  static const std::vector<CurveFigure> all{
      {{"curve/pull_off", "N", "pull-off force $F_\\mathrm{po}$",
        "largest pull while the probe is retracted"},
       [](C c) { return c.pull_off; }},
      {{"curve/work", "J", "pull-off work $W$",
        "area below the zero-force line during retraction, over the travel of the scanner"},
       [](C c) { return c.work; }},
      {{"curve/work_of_adhesion", "J/m^2", "work of adhesion $w$",
        "from the pull-off force and the tip's radius, by DMT or JKR"},
       [](C c) { return c.work_of_adhesion.value_or(std::nan("")); }}};
  return all;
}

// Figures compared with the closed forms for a lever's shape.
void add_closed_form_figures(std::vector<SeriesInfo>& all, LeverSpec::Shape shape) {
  for (const ClosedFormId& form : closed_form_ids(shape)) {
    for (const auto& [quantity, has] : {std::pair{"k_n", form.normal}, {"k_l", form.lateral}}) {
      if (!has) continue;
      const std::string stiffness =
          quantity == std::string("k_n") ? "normal stiffness" : "lateral stiffness";
      all.push_back({"closed/" + form.id + "/" + quantity, "N/m",
                     fmt::format("{} by closed form ({}) ${}$", stiffness, form.id, quantity),
                     "by the closed form"});
      all.push_back({std::string(quantity) + "/" + form.id, "-",
                     fmt::format("{} over its closed form ({})", stiffness, form.id),
                     "relative to the closed form"});
    }
    if (form.normal && form.lateral)
      all.push_back(
          {"k_l/k_n/" + form.id, "-",
           fmt::format("lateral over normal stiffness, over its closed form ({})", form.id),
           "relative to the ratio of the closed forms"});
  }
}

void add_closed_form_values(std::map<std::string, double>& values, const Calibration& c) {
  for (const ClosedForm& form : c.closed_forms) {
    const bool normal = form.quantity == "k_n";
    values["closed/" + form.id + "/" + form.quantity] = form.value;
    values[form.quantity + "/" + form.id] =
        (normal ? c.normal_stiffness : c.lateral_stiffness) / form.value;
  }
  for (const ClosedForm& form : c.closed_forms)  // normal ones come first
    if (form.quantity == "k_l" && values.contains("k_n/" + form.id))
      values["k_l/k_n/" + form.id] = values["k_l/" + form.id] / values["k_n/" + form.id];
}

}  // namespace

std::vector<SeriesInfo> afm_figures() {
  std::vector<SeriesInfo> all;
  for (const Figure& figure : calibration_figures()) all.push_back(figure.info);
  for (const LoopFigure& figure : loop_figures()) all.push_back(figure.info);
  for (const CurveFigure& figure : curve_figures()) all.push_back(figure.info);
  for (const auto shape : {LeverSpec::Shape::beam, LeverSpec::Shape::v})
    add_closed_form_figures(all, shape);
  return all;
}

std::vector<SeriesInfo> afm_expectable_series(const Scene& scene) {
  std::vector<SeriesInfo> all =
      scene.afm->actions.empty() ? std::vector<SeriesInfo>{} : afm_series();
  for (const SeriesInfo& info : afm_figures_of(scene)) all.push_back(info);
  return all;
}

std::vector<SeriesInfo> afm_figures_of(const Scene& scene) {
  std::vector<SeriesInfo> all;
  for (const Figure& figure : calibration_figures()) all.push_back(figure.info);
  add_closed_form_figures(all, scene.afm->lever.shape);
  bool loops = false;
  for (const ActionSpec& action : scene.afm->actions)
    loops = loops || (action.kind == ActionSpec::Kind::scan && action.retrace);
  if (loops)
    for (const LoopFigure& figure : loop_figures()) all.push_back(figure.info);
  if (has_force_curve(scene))
    for (const CurveFigure& figure : curve_figures()) all.push_back(figure.info);
  return all;
}

std::map<std::string, double> afm_figure_values(const Calibration& calibration,
                                                const std::vector<FrictionLoop>& loops,
                                                const std::vector<ForceCurveFigures>& curves) {
  std::map<std::string, double> values;
  for (const Figure& figure : calibration_figures())
    values[figure.info.name] = figure.of(calibration);
  add_closed_form_values(values, calibration);
  if (!loops.empty())
    for (const LoopFigure& figure : loop_figures())
      values[figure.info.name] = figure.of(loops.back());
  if (!curves.empty())
    for (const CurveFigure& figure : curve_figures())
      values[figure.info.name] = figure.of(curves.back());
  return values;
}

}  // namespace pulvis
