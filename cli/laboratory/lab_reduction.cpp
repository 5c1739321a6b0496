#include "cli/laboratory/lab_reduction.hpp"

#include "cli/laboratory/lab_friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pulvis::lab {
namespace {

constexpr std::size_t fewest_dynamic = 20;  // samples

std::vector<double> calibrated(const LoggerRecord& logger, const LoadCellSpec& cell) {
  std::vector<double> force;
  for (const double strain : logger.strain) force.push_back(cell.gain * strain + cell.offset);
  return force;
}

// The shear force while the plate is at rest: its mean and noise.
Sample standstill(const LoggerRecord& logger, const std::vector<double>& shear, double start) {
  const Samples s = between(logger.time, logger.time.front(), start - logger.interval);
  return sample_of(std::span(shear).subspan(s.begin, s.count()));
}

class CurveMaker {
 public:
  CurveMaker(const PressRecord& press, const LoggerRecord& logger, const Settings& settings,
             const Clocks& clocks)
      : press_(press), logger_(logger), settings_(settings), clocks_(clocks) {
    at_start_ = interpolated(press.time, press.displacement, clocks.press_start.time);
  }

  void add(Curve& curve, std::size_t sample, double distance, double shear) const {
    const double time = logger_.time[sample], on_press = clocks_.press_time(time);
    const double punch = interpolated(press_.time, press_.force, on_press);
    const double displacement = interpolated(press_.time, press_.displacement, on_press);
    const double length = length_at(displacement, sample);
    const CompactSpec& compact = settings_.compact;
    const double k = wall_exponent(compact.radial_ratio(), length, compact.die_diameter);
    const double friction = friction_at(shear / punch, k, sample);
    curve.time.push_back(time - clocks_.logger_start.time);
    curve.distance.push_back(distance);
    curve.shear_force.push_back(shear);
    curve.punch_force.push_back(punch);
    curve.punch_travel.push_back(displacement - at_start_);
    curve.length.push_back(length);
    curve.target_force.push_back(punch * std::exp(-k * compact.wall_friction.value_or(friction)));
    curve.friction.push_back(friction);
  }

 private:
  double length_at(double displacement, std::size_t sample) const {
    const CompactSpec& compact = settings_.compact;
    const double length = compact.length ? *compact.length - (displacement - at_start_)
                                         : *compact.fill_height - displacement;
    if (!(length > 0))
      refuse(logger_, sample, "compact",
             fmt::format("the punch has moved {:.4g} mm, which leaves no compact, allowed: a "
                         "length or fill_height that is larger than the punch displacement",
                         displacement * 1e3));
    return length;
  }

  double friction_at(double ratio, double k, std::size_t sample) const {
    if (settings_.compact.wall_friction)
      return ratio * std::exp(k * *settings_.compact.wall_friction);
    const std::optional<double> friction = friction_coefficient(ratio, k);
    if (!friction)
      refuse(logger_, sample, settings_.logger.strain,
             fmt::format("the shear force is {:.4g} of the force on the punch, which is not "
                         "possible with any coefficient in (3.1) with (3.2), allowed: up to {:.4g} "
                         "for this compact, or a separate compact.wall_friction",
                         ratio, largest_ratio(k)));
    return *friction;
  }

  const PressRecord& press_;
  const LoggerRecord& logger_;
  const Settings& settings_;
  const Clocks& clocks_;
  double at_start_ = 0;
};

FrictionCurve dynamic_part(const Curve& curve, const Dynamic& dynamic) {
  const Samples s = between(curve.time, 0, curve.time.back());
  std::size_t begin = s.begin, end = s.end;
  while (begin < end && curve.distance[begin] < dynamic.from) ++begin;
  while (end > begin && curve.distance[end - 1] > dynamic.until) --end;
  const auto part = [&](const std::vector<double>& all) {
    return std::span(all).subspan(begin, end - begin);
  };
  return {part(curve.distance), part(curve.time), part(curve.friction), part(curve.shear_force)};
}

// Drops samples where noise makes the distance decrease.
struct Forward {
  std::vector<double> distance, values;
};
Forward forward(const std::vector<double>& distance, const std::vector<double>& values) {
  Forward kept;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (!kept.distance.empty() && distance[i] <= kept.distance.back()) continue;
    kept.distance.push_back(distance[i]);
    kept.values.push_back(values[i]);
  }
  return kept;
}

// Mean of the piecewise linear curve over [low, high].
double mean_over(const Forward& f, double low, double high) {
  double area = 0, x = low, y = interpolated(f.distance, f.values, low);
  const auto add = [&](double to, double value) {
    area += (y + value) / 2 * (to - x);
    x = to;
    y = value;
  };
  for (std::size_t i = 0; i < f.distance.size(); ++i)
    if (f.distance[i] > low && f.distance[i] < high) add(f.distance[i], f.values[i]);
  add(high, interpolated(f.distance, f.values, high));
  return area / (high - low);
}

// d mu / d F_l at the middle of the curve: 1/F_b, and with one coefficient for wall and target
// 1/(F_b (1 - k mu)), where k mu = ln(F_t/F_b).
double coefficient_for_force(const Curve& curve, const CompactSpec& compact) {
  const double target = sample_of(curve.target_force).mean;
  const double exponent = std::log(sample_of(curve.punch_force).mean / target);
  return 1 / (target * (compact.wall_friction ? 1 : 1 - exponent));
}

void check_pull(const LoggerRecord& logger, const Curve& curve, const std::string& key) {
  if (!(sample_of(curve.shear_force).mean > 0))
    refuse(logger, key,
           "the mean shear force is not positive, allowed: a load cell in compression, or a "
           "load_cell.gain of the opposite sign");
}

}  // namespace

Static static_peak(const Curve& curve, double within) {
  Static peak{curve.friction.front(), curve.distance.front(), false};
  for (std::size_t i = 0; i < curve.friction.size(); ++i)
    if (curve.distance[i] <= within && curve.friction[i] > peak.value)
      peak = {curve.friction[i], curve.distance[i], false};
  return peak;
}

Dynamic dynamic_mean(const Curve& curve, const AnalysisSpec& spec) {
  Dynamic dynamic;
  const double end = *std::max_element(curve.distance.begin(), curve.distance.end());
  dynamic.from = spec.dynamic_from;
  dynamic.until = std::min(spec.dynamic_until.value_or(end), end);
  const FrictionCurve part = dynamic_part(curve, dynamic);
  dynamic.mean = mean_over(forward(curve.distance, curve.friction), dynamic.from, dynamic.until);
  dynamic.deviation = sample_of(part.coefficient).deviation;
  dynamic.trend = fit_line(part.distance, part.coefficient).slope;
  return dynamic;
}

namespace {

// The dynamic coefficient of an elastic compact; empty where (3.1) with (3.2) has no solution.
std::optional<double> elastic_dynamic(Curve curve, const Settings& settings) {
  const CompactSpec& compact = settings.compact;
  for (std::size_t i = 0; i < curve.friction.size(); ++i) {
    const double k = wall_exponent(compact.elastic_ratio(), curve.length[i], compact.die_diameter);
    const double ratio = curve.shear_force[i] / curve.punch_force[i];
    const std::optional<double> friction = compact.wall_friction
                                               ? ratio * std::exp(k * *compact.wall_friction)
                                               : friction_coefficient(ratio, k);
    if (!friction) return std::nullopt;
    curve.friction[i] = *friction;
  }
  return dynamic_mean(curve, settings.analysis).mean;
}

}  // namespace

ReducedRun reduce(const PressRecord& press, const LoggerRecord& logger, const Settings& settings,
                  const RunFiles& files) {
  ReducedRun run;
  run.name = files.name;
  run.press = files.press;
  run.logger = files.logger;
  const Sliding sliding = find_sliding(logger, settings);
  run.clocks = match_clocks(press, logger, sliding, settings.clock, settings.press.hold_tolerance,
                            files.offset);
  run.has_end = sliding.end.has_value();
  const std::vector<double> shear = calibrated(logger, settings.load_cell);
  const Sample rest = standstill(logger, shear, sliding.start.time);
  const bool tares = settings.load_cell.zero == LoadCellSpec::Zero::standstill;
  run.shear_zero = tares ? rest.mean : 0;
  const CurveMaker maker(press, logger, settings, run.clocks);
  const Samples s = between(logger.time, sliding.start.time, sliding.last_time);
  for (std::size_t i = s.begin; i < s.end; ++i)
    maker.add(run.curve, i, sliding.distance[i], shear[i] - run.shear_zero);
  check_pull(logger, run.curve, settings.logger.strain);

  const AnalysisSpec& analysis = settings.analysis;
  const double end = *std::max_element(run.curve.distance.begin(), run.curve.distance.end());
  Dynamic window;
  window.from = analysis.dynamic_from;
  window.until = std::min(analysis.dynamic_until.value_or(end), end);
  const std::size_t samples = dynamic_part(run.curve, window).distance.size();
  if (samples < fewest_dynamic)
    refuse(logger, settings.logger.lvdt,
           fmt::format("the plate slides {:.4g} mm, with {} samples for the dynamic mean, allowed: "
                       "at least {} beyond {:.4g} mm (analysis.dynamic_from)",
                       end * 1e3, samples, fewest_dynamic, analysis.dynamic_from * 1e3));
  run.speed = end / (sliding.last_time - sliding.start.time);
  run.noise = rest.deviation * coefficient_for_force(run.curve, settings.compact);
  run.dynamic = dynamic_mean(run.curve, analysis);
  if (settings.compact.stress_ratio) run.elastic_dynamic = elastic_dynamic(run.curve, settings);
  run.stick_slip = find_stick_slip(dynamic_part(run.curve, run.dynamic), run.noise);
  if (const double first = std::ranges::min(run.curve.distance); first > analysis.static_within)
    refuse(logger, settings.logger.lvdt,
           fmt::format("no sample lies within {:.4g} mm of the start (analysis.static_within), the "
                       "first at {:.4g} mm, allowed: a distance of at least that",
                       analysis.static_within * 1e3, first * 1e3));
  run.peak = static_peak(run.curve, analysis.static_within);
  const double swing = run.stick_slip ? run.stick_slip->amplitude / 2 : 2 * run.dynamic.deviation;
  run.peak.is_distinct = run.peak.value > run.dynamic.mean + swing + 3 * run.noise;
  return run;
}

std::vector<double> on_grid(const std::vector<double>& distance, const std::vector<double>& values,
                            double step) {
  const Forward f = forward(distance, values);
  std::vector<double> result;
  for (std::size_t i = 0; static_cast<double>(i) * step <= f.distance.back(); ++i)
    result.push_back(interpolated(f.distance, f.values, static_cast<double>(i) * step));
  return result;
}

Repeatability repeatability(const std::vector<ReducedRun>& runs, double step) {
  std::vector<double> peaks, means, amplitudes, periods;
  std::vector<std::vector<double>> curves;
  for (const ReducedRun& run : runs) {
    peaks.push_back(run.peak.value);
    means.push_back(run.dynamic.mean);
    if (run.stick_slip) amplitudes.push_back(run.stick_slip->amplitude);
    if (run.stick_slip) periods.push_back(run.stick_slip->period);
    curves.push_back(on_grid(run.curve.distance, run.curve.friction, step));
  }
  Repeatability result{
      sample_of(peaks), sample_of(means), sample_of(amplitudes), sample_of(periods), {}};
  std::size_t shortest = curves.front().size();
  for (const auto& curve : curves) shortest = std::min(shortest, curve.size());
  for (std::size_t i = 0; i < shortest; ++i) {
    std::vector<double> values;
    for (const auto& curve : curves) values.push_back(curve[i]);
    result.friction.push_back(sample_of(values));
  }
  return result;
}

}  // namespace pulvis::lab
