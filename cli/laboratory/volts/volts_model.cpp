#include "cli/laboratory/volts/volts_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/language/problem.hpp"

namespace pulvis::volts {
namespace {

constexpr double level_slope = 1e-6;  // rad: wedge_calibration treats it as flat

// The uncertainty of every value of a set of loops: as stated, scaled up if they scatter more about their line over
// the loads; without a stated one the scatter alone.
std::vector<double> errors_of(const LoopRecord& record, const std::vector<std::size_t>& set,
                              double VoltsLoop::*value, std::optional<double> VoltsLoop::*stated) {
  std::vector<double> load, y, error;
  bool known = true;
  for (const std::size_t i : set) {
    load.push_back(record.loops[i].load);
    y.push_back(record.loops[i].*value);
    error.push_back((record.loops[i].*stated).value_or(0));
    known = known && error.back() > 0;
  }
  const auto [low, high] = std::ranges::minmax(load);
  if (set.size() < 3 || !(high > low)) {
    if (known) return error;
    throw SceneError(
        {{record.file.string(), 1, 1, "", "half_width_error",
          fmt::format("the uncertainty of {} is not given, allowed: raw traces, half_width_error "
                      "and offset_error, or three loads on every slope",
                      set.size() == 1 ? "this loop and its slope" : "two loops")}});
  }
  const lab::Line line = lab::fit_line(load, y);
  const double scatter = std::sqrt(line.residual / static_cast<double>(set.size() - 2));
  if (!known) return std::vector<double>(set.size(), scatter);
  double chi2 = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double rest = (y[i] - line.at(load[i])) / error[i];
    chi2 += rest * rest;
  }
  const double more = std::max(1.0, std::sqrt(chi2 / static_cast<double>(set.size() - 2)));
  for (double& e : error) e *= more;
  return error;
}

lab::Mean share_of(double value, double relative) { return {value, std::abs(value) * relative}; }

}  // namespace

Model::Model(const Measured& measured, const VoltsSpec& spec, bool takes_other_root)
    : measured_(measured), lateral_(spec.lateral()) {
  add("normal stiffness", "k_n", "N/m", share_of(measured.lever.k_n, *spec.lever.k_n_error));
  add("deflection sensitivity", "sensitivity", "V/m", measured.hard.slope);
  add("piezo", "piezo", "-", {1, spec.force_curves.piezo_error});
  add("pull-off, volts", "pull_off", "V", measured.sample.pull_off);
  if (measured.crosstalk) add("crosstalk", "crosstalk", "-", *measured.crosstalk);
  if (lateral_ == LateralMethod::wedge)
    add_wedge(takes_other_root);
  else
    add_test_probe(spec);
  add("free level of the loops", "level", "V", {0, spec.afm.level_error});
  sample_ = add_loops("loops on the sample", measured_.loops, false);
}

std::size_t Model::add(const std::string& group, const std::string& name, const char* unit,
                       const lab::Mean& value) {
  auto found = std::ranges::find(groups_, group);
  if (found == groups_.end()) found = groups_.insert(groups_.end(), group);
  inputs_.push_back(
      {name, unit, static_cast<int>(found - groups_.begin()), value.value, value.error});
  at_[name] = inputs_.size() - 1;
  return inputs_.size() - 1;
}

Model::LoopInputs Model::add_loops(const std::string& group, const LoopRecord& record,
                                   bool offsets) {
  LoopInputs made{std::vector<std::size_t>(record.loops.size()), {}};
  if (offsets) made.offset.resize(record.loops.size());
  std::map<double, std::vector<std::size_t>> by_slope;
  for (std::size_t i = 0; i < record.loops.size(); ++i)
    by_slope[record.loops[i].slope].push_back(i);
  for (const auto& [slope, set] : by_slope) {
    const auto width = errors_of(record, set, &VoltsLoop::half_width, &VoltsLoop::half_width_error);
    const auto offset = offsets
                            ? errors_of(record, set, &VoltsLoop::offset, &VoltsLoop::offset_error)
                            : std::vector<double>();
    for (std::size_t k = 0; k < set.size(); ++k) {
      const VoltsLoop& loop = record.loops[set[k]];
      const std::string name = fmt::format("{} {}", group, set[k] + 1);
      made.width[set[k]] = add(group, name + ", half-width", "V", {loop.half_width, width[k]});
      if (offsets)
        made.offset[set[k]] = add(group, name + ", offset", "V", {loop.offset, offset[k]});
    }
  }
  return made;
}

void Model::add_wedge(bool takes_other_root) {
  wedge_ = add_loops("loops on slopes", *measured_.wedge, true);
  for (const VoltsLoop& loop : measured_.wedge->loops)
    if (!slope_at_.contains(loop.slope))
      slope_at_[loop.slope] =
          add("angles of the slopes",
              fmt::format("slope of {:.4g} deg", loop.slope * 180 / std::numbers::pi), "rad",
              {loop.slope, measured_.known.slope_error});
  add("loads on the slopes", "wedge_load", "-", {1, measured_.known.load_error});
  weigh_slopes(takes_other_root);
}

void Model::add_test_probe(const VoltsSpec& spec) {
  const TestProbeSpec& probe = spec.test_probe;
  const Lever& lever = measured_.lever;
  add("lateral stiffness", "k_l", "N/m", share_of(*lever.k_l, *spec.lever.k_l_error));
  add("arm of the lever", "arm", "m", share_of(*lever.arm, spec.lever.arm_error));
  add("test probe: slope of side contacts", "side", "V/m", *measured_.side);
  add("test probe: piezo", "side_piezo", "-", {1, probe.piezo_error});
  add("test probe: arm", "probe_arm", "m", share_of(*probe.arm, probe.arm_error));
  add("test probe: light", "intensity", "-",
      share_of(probe.intensity_ratio, probe.intensity_error));
  add("test probe: twist", "probe_twist", "-", {probe.twist_share, 0});
}

std::vector<double> Model::values() const {
  std::vector<double> x;
  for (const Input& input : inputs_) x.push_back(input.value);
  return x;
}

// The normal volts used for the crosstalk: measured along with the trace, or those of the load.
double Model::normal_volts(const LoopRecord& record, const VoltsLoop& loop, double normal) const {
  if (loop.normal_mean) return *loop.normal_mean;
  return record.load_in_volts ? loop.load : loop.load / normal;
}

std::vector<wedge::Loop> Model::loops_on_slopes(const std::vector<double>& x, double normal,
                                                double crosstalk) const {
  const LoopRecord& record = *measured_.wedge;
  const double load_factor = x[at_.at("wedge_load")] * (record.load_in_volts ? normal : 1);
  std::vector<wedge::Loop> loops;
  for (std::size_t i = 0; i < record.loops.size(); ++i) {
    const VoltsLoop& loop = record.loops[i];
    const bool flat = std::abs(loop.slope) < level_slope;
    loops.push_back({flat ? loop.slope : x[slope_at_.at(loop.slope)], load_factor * loop.load,
                     x[wedge_.width[i]] - crosstalk * loop.normal_half,
                     x[wedge_.offset[i]] - crosstalk * normal_volts(record, loop, normal),
                     inputs_[wedge_.width[i]].error, inputs_[wedge_.offset[i]].error});
  }
  return loops;
}

wedge::Calibration Model::on_slopes(const std::vector<wedge::Loop>& loops) const {
  return wedge::calibrate_at(
      loops, {measured_.known.adhesion, measured_.known.slope_error, 0, std::nullopt}, root_);
}

// The mean over the slopes with the weights of the nominal values: weights that vary with a draw would count the
// disagreement of the slopes as uncertainty twice.
double Model::weighted(const wedge::Calibration& calibration) const {
  double mean = 0;
  std::size_t i = 0;
  for (const wedge::Facet& facet : calibration.facets)
    if (facet.sensitivity) mean += weights_.at(i++) * facet.sensitivity->value;
  return mean;
}

double Model::lateral_by_wedge(const std::vector<double>& x, double normal,
                               double crosstalk) const {
  std::vector<wedge::Loop> loops = loops_on_slopes(x, normal, crosstalk);
  const wedge::Calibration calibration = on_slopes(loops);
  double sensitivity = weighted(calibration);
  const auto flat = std::ranges::find_if(
      slope_at_, [](const auto& slope) { return std::abs(slope.first) < level_slope; });
  const double tilt = flat == slope_at_.end() ? 0 : x[flat->second] - flat->first;
  if (tilt != 0) {
    // The offset due to a flat facet not being flat is not crosstalk: Delta = (1 + mu^2) L tilt.
    const double mu = calibration.friction.value;
    const double by_load = (1 + mu * mu) * tilt / sensitivity;
    for (wedge::Loop& loop : loops)
      if (std::abs(loop.slope) < level_slope) loop.offset -= by_load * loop.load;
    sensitivity = weighted(on_slopes(loops));
  }
  return sensitivity * (disagree_ ? x[at_.at("disagreement")] : 1);
}

void Model::weigh_slopes(bool takes_other_root) {
  const double normal = measured_.lever.k_n / measured_.hard.slope.value;
  const double crosstalk = measured_.crosstalk ? measured_.crosstalk->value : 0;
  const auto loops = loops_on_slopes(values(), normal, crosstalk);
  const WedgeKnown& known = measured_.known;
  wedge::Calibration calibration;
  try {
    slopes_ =
        wedge::calibrate(loops, {known.adhesion, known.slope_error, 0, known.expected_friction});
    root_ = slopes_->root;
    if (takes_other_root)
      root_ = root_ == wedge::Root::lower ? wedge::Root::upper : wedge::Root::lower;
    calibration = on_slopes(loops);
  } catch (const std::runtime_error& error) {
    throw SceneError({{measured_.wedge->file.string(), 1, 1, "", "wedge", error.what()}});
  }
  weights_ = calibration.weights;
  const wedge::Value& mean = calibration.sensitivity;
  if (!(calibration.disagreement > 1) || !mean.error) return;
  disagree_ = true;  // the part that the Birge ratio adds to the variance of the mean
  add("slopes that disagree", "disagreement", "-",
      {1, *mean.error / mean.value * std::sqrt(1 - 1 / calibration.disagreement)});
}

double Model::lateral_by_probe(const std::vector<double>& x) const {
  const auto of = [&](const char* name) { return x[at_.at(name)]; };
  return of("k_l") * of("arm") * of("probe_twist") /
         (measured_.lever.twist_share * of("intensity") * of("side") / of("side_piezo") *
          of("probe_arm"));
}

Outcome Model::evaluate(const std::vector<double>& x) const {
  const auto of = [&](const char* name) { return x[at_.at(name)]; };
  Outcome out;
  out.normal = of("k_n") * of("piezo") / of("sensitivity");
  out.adhesion = out.normal * of("pull_off");
  const double crosstalk = measured_.crosstalk ? of("crosstalk") : 0;
  out.lateral = lateral_ == LateralMethod::wedge ? lateral_by_wedge(x, out.normal, crosstalk)
                                                 : lateral_by_probe(x);
  const LoopRecord& record = measured_.loops;
  for (std::size_t i = 0; i < record.loops.size(); ++i) {
    const VoltsLoop& loop = record.loops[i];
    out.load.push_back(loop.load * (record.load_in_volts ? out.normal : 1) +
                       out.normal * of("level"));
    out.force.push_back(out.lateral * (x[sample_.width[i]] - crosstalk * loop.normal_half));
    out.friction_of_loop.push_back(out.force[i] / (out.load[i] + out.adhesion));
    out.friction_of_loops += out.friction_of_loop[i] / static_cast<double>(record.loops.size());
  }
  const auto [low, high] = std::ranges::minmax(out.load);
  out.friction = out.friction_of_loops;
  if (!(high > low)) return out;
  const lab::Line line = lab::fit_line(out.load, out.force);
  out.friction = line.slope;
  out.adhesion_of_line = line.at(0) / line.slope;
  return out;
}

}  // namespace pulvis::volts
