#include "cli/laboratory/volts/force_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "engine/portable_math.hpp"

namespace pulvis::volts {
namespace {

constexpr std::size_t fewest_in_line = 8;
constexpr double clear_of_noise = 5;

// One direction of a curve, in order of increasing displacement.
struct Trace {
  std::vector<double> d, y;
  std::vector<double> lateral;
};

Trace trace_of(const ForceCurve& curve, bool back) {
  Trace trace;
  const std::size_t n = curve.displacement.size();
  const std::size_t begin = back ? curve.turn : 0, end = back ? n : curve.turn + 1;
  for (std::size_t k = begin; k < end; ++k) {
    const std::size_t i = back ? n - 1 - (k - begin) : k;
    trace.d.push_back(curve.displacement[i]);
    trace.y.push_back(curve.normal[i]);
    if (!curve.lateral.empty()) trace.lateral.push_back(curve.lateral[i]);
  }
  return trace;
}

[[noreturn]] void wrong(const ForceCurve& curve, const std::string& what) {
  throw std::runtime_error(fmt::format("curve {}: {}", curve.name, what));
}

double noise_about(const lab::Line& line) {
  return std::sqrt(line.residual / static_cast<double>(line.count - 2));
}

std::vector<double> rest_of(const lab::Line& line, std::span<const double> t,
                            std::span<const double> y) {
  std::vector<double> rest;
  for (std::size_t i = 0; i < t.size(); ++i) rest.push_back(y[i] - line.at(t[i]));
  return rest;
}

// Subtracts the line of zero force.
void level(const ForceCurve& curve, const CurveWindow& window, Trace& trace, Way& way) {
  const double end = window.free * curve.displacement[curve.turn];
  const auto count =
      static_cast<std::size_t>(std::ranges::count_if(trace.d, [&](double d) { return d <= end; }));
  if (count < fewest_in_line)
    wrong(curve, fmt::format("{} samples are free of the surface, allowed: at least {}", count,
                             fewest_in_line));
  const auto d = std::span(trace.d).first(count), y = std::span(trace.y).first(count);
  way.free = lab::fit_line(d, y);
  way.free_inflation = lab::inflation_of(rest_of(way.free, d, y));
  for (std::size_t i = 0; i < trace.d.size(); ++i) trace.y[i] -= way.free.at(trace.d[i]);
}

struct Part {
  std::size_t begin = 0, end = 0;
};

// The samples of the contact line: from the last below the lower share to the first above the upper one.
Part contact_part(const CurveWindow& window, const Trace& trace) {
  const double most = *std::ranges::max_element(trace.y);
  Part part{0, 0};
  for (std::size_t i = 0; i < trace.y.size(); ++i)
    if (trace.y[i] < window.from * most) part.begin = i + 1;
  part.end = part.begin;
  while (part.end < trace.y.size() && trace.y[part.end] <= window.until * most) ++part.end;
  return part;
}

// Adhesion that holds the probe over the retract makes the line taken for zero force one of contact.
bool is_held(const Way& approach, const Way& retract) {
  constexpr double similar = 0.5;  // of the contact slope
  const double excess = retract.free.slope - approach.free.slope;
  const double sure = portable::hypot(lab::slope_error(approach.free, approach.free_inflation),
                                      lab::slope_error(retract.free, retract.free_inflation));
  return excess > similar * approach.contact.slope && excess > clear_of_noise * sure;
}

// `approach` of the same curve has a signal; none for the approach itself.
void require_signal(const ForceCurve& curve, const Trace& trace, const Way& way,
                    const Way* approach) {
  const bool none =
      !(*std::ranges::max_element(trace.y) > 2 * clear_of_noise * noise_about(way.free)) ||
      curve.turn == 0;
  if (approach && (none || is_held(*approach, way)))
    wrong(curve,
          fmt::format(
              "the probe does not leave the surface before the range of force_curves.free "
              "on retract: the volts change there by {:.3g} V/um, in contact on approach by "
              "{:.3g} V/um, allowed: a longer retract",
              way.free.slope * 1e-6, (approach->contact.slope + approach->free.slope) * 1e-6));
  if (none)
    wrong(curve,
          "no contact signal above the noise, allowed: volts that increase where the probe is "
          "pressed on");
}

Way way_of(const ForceCurve& curve, const CurveWindow& window, Trace& trace,
           const Way* approach = nullptr) {
  Way way;
  level(curve, window, trace, way);
  require_signal(curve, trace, way, approach);
  const Part part = contact_part(window, trace);
  const std::size_t count = part.end - part.begin;
  if (count < fewest_in_line)
    wrong(curve,
          fmt::format(
              "{} samples lie between {:g} and {:g} of the largest signal, allowed: at least {}",
              count, window.from, window.until, fewest_in_line));
  const auto d = std::span(trace.d).subspan(part.begin, count);
  const auto y = std::span(trace.y).subspan(part.begin, count);
  way.contact = lab::fit_line(d, y);
  // The line of zero force is subtracted together with its slope.
  way.slope_error =
      portable::hypot(lab::slope_error(way.contact, lab::inflation_of(rest_of(way.contact, d, y))),
                      lab::slope_error(way.free, way.free_inflation));
  const std::size_t half = count / 2;
  way.curvature = lab::fit_line(d.subspan(half), y.subspan(half)).slope /
                      lab::fit_line(d.first(half), y.first(half)).slope -
                  1;
  return way;
}

void find_pull_off(const ForceCurve& curve, const CurveWindow& window, const Trace& back,
                   CurveFigures& figures) {
  auto least = static_cast<std::size_t>(std::ranges::min_element(back.y) - back.y.begin());
  const double noise = figures.noise;
  figures.pull_off = {0, noise};
  if (!(back.y[least] < -clear_of_noise * noise)) return;
  if (least == 0 || back.d[least] <= window.free * curve.displacement[curve.turn])
    wrong(curve,
          fmt::format("the probe leaves the surface at {:.4g} m, which is within the range of "
                      "force_curves.free, allowed: a longer retract, or a share smaller than {:g}",
                      back.d[least], window.free));
  // Noise may put the smallest sample before the last one in tension.
  for (const double half = back.y[least] / 2; least > 1 && back.y[least - 1] < half;) --least;
  std::size_t end = least;
  while (end < back.y.size() && back.y[end] < 0) ++end;
  const double step = back.d[least] - back.d[least - 1], at = back.d[least] - step / 2;
  const Way& way = *figures.retract;
  const double sure = portable::hypot(way.contact.slope * step / std::sqrt(12.0),
                                      lab::value_error(way.free, at, way.free_inflation));
  figures.pull_off_at = at;
  if (end - least < fewest_in_line) {
    figures.pull_off = {way.contact.slope * step / 2 - back.y[least], portable::hypot(noise, sure)};
  } else {
    const auto d = std::span(back.d).subspan(least, end - least);
    const auto y = std::span(back.y).subspan(least, end - least);
    const lab::Line line = lab::fit_line(d, y);
    const double inflation = lab::inflation_of(rest_of(line, d, y));
    figures.pull_off = {-line.at(at), portable::hypot(lab::value_error(line, at, inflation), sure)};
  }
  // Trapezoids, plus the strip up to the pull-off.
  figures.work = (figures.pull_off.value - back.y[least]) / 2 * (back.d[least] - at);
  for (std::size_t i = least; i + 1 < end; ++i)
    figures.work -= (back.y[i] + back.y[i + 1]) / 2 * (back.d[i + 1] - back.d[i]);
}

// Lateral against normal volts in the contact part of one direction.
lab::Mean crosstalk_of(const CurveWindow& window, const Trace& trace) {
  const Part part = contact_part(window, trace);
  const auto y = std::span(trace.y).subspan(part.begin, part.end - part.begin);
  const auto lateral = std::span(trace.lateral).subspan(part.begin, part.end - part.begin);
  const lab::Line line = lab::fit_line(y, lateral);
  return {line.slope, lab::slope_error(line, lab::inflation_of(rest_of(line, y, lateral)))};
}

// Mean of both directions; their difference is treated as uniformly distributed about it.
lab::Mean of_both(const lab::Mean& a, const lab::Mean& b) {
  const double own = portable::hypot(a.error, b.error) / 2;
  return {(a.value + b.value) / 2,
          portable::hypot(own, std::abs(a.value - b.value) / 2 / std::sqrt(3.0))};
}

// Correction for a scatter of few values: the variance of Student's distribution with n - 1 degrees of freedom,
// (n - 1)/(n - 3) (JCGM 101:2008, 6.4.9.4). It is infinite below four values: those use that of four.
double few_values(double n) { return (n - 1) / std::max(n - 3, (n - 1) / 3); }

lab::Mean mean_of_curves(const std::vector<lab::Mean>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, own = 0, scatter = 0;
  for (const lab::Mean& v : values) mean += v.value / n, own += v.error * v.error / (n * n);
  for (const lab::Mean& v : values) scatter += (v.value - mean) * (v.value - mean);
  if (values.size() > 1) own = std::max(own, few_values(n) * scatter / (n - 1) / n);
  return {mean, std::sqrt(own)};
}

}  // namespace

CurveFigures figures_of(const ForceCurve& curve, const CurveWindow& window) {
  CurveFigures figures;
  Trace there = trace_of(curve, false);
  figures.approach = way_of(curve, window, there);
  figures.noise = noise_about(figures.approach.free);
  figures.sensitivity = {figures.approach.contact.slope, figures.approach.slope_error};
  std::optional<lab::Mean> crosstalk;
  if (!there.lateral.empty()) crosstalk = crosstalk_of(window, there);
  const bool returns = curve.turn + fewest_in_line < curve.displacement.size();
  if (window.needs_return && !returns)
    wrong(curve, fmt::format("ends {} samples after its turning point, without a retract, allowed: "
                             "an approach and a retract of the same curve",
                             curve.displacement.size() - 1 - curve.turn));
  if (returns) {
    Trace back = trace_of(curve, true);
    figures.retract = way_of(curve, window, back, &figures.approach);
    find_pull_off(curve, window, back, figures);
    figures.sensitivity = of_both(figures.sensitivity,
                                  {figures.retract->contact.slope, figures.retract->slope_error});
    if (crosstalk) crosstalk = of_both(*crosstalk, crosstalk_of(window, back));
  }
  figures.crosstalk = crosstalk;
  return figures;
}

Sensitivity mean_over(const std::vector<CurveFigures>& curves) {
  std::vector<lab::Mean> there, back, pull_off, crosstalk;
  for (const CurveFigures& curve : curves) {
    there.push_back({curve.approach.contact.slope, curve.approach.slope_error});
    if (curve.retract) back.push_back({curve.retract->contact.slope, curve.retract->slope_error});
    pull_off.push_back(curve.pull_off);
    if (curve.crosstalk) crosstalk.push_back(*curve.crosstalk);
  }
  Sensitivity all;
  all.slope = mean_of_curves(there);
  if (!back.empty()) all.slope = of_both(all.slope, mean_of_curves(back));
  all.pull_off = mean_of_curves(pull_off);
  if (crosstalk.size() == curves.size()) all.crosstalk = mean_of_curves(crosstalk);
  return all;
}

}  // namespace pulvis::volts
