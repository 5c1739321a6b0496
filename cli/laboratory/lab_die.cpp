#include "cli/laboratory/lab_die.hpp"

#include "cli/laboratory/lab_simulation.hpp"
#include "scenes/language/csv_table.hpp"
#include "scenes/results/compaction_curve.hpp"
#include "scenes/solve/lab_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pulvis::lab {
namespace {

constexpr std::size_t fewest_in_step = 5;  // samples

struct SliceState {
  double top = 0, bottom = 0, radial = 0, height = 0;
};

struct Slice {
  double stress_ratio = 0, friction = 0;
};

// Empty where a punch or the wall carries no load, or the gauge lies above the compact.
std::optional<Slice> slice_of(const SliceState& s, const DieCurve& die) {
  if (!(s.top > 0) || !(s.bottom > 0) || !(s.radial > 0)) return std::nullopt;
  const double loss = std::log(s.top / s.bottom);
  double axial = std::abs(loss) > 1e-9 ? (s.top - s.bottom) / loss : s.top;
  if (die.radial_height) {
    if (*die.radial_height > s.height) return std::nullopt;
    axial = s.top * std::exp(-loss * (1 - *die.radial_height / s.height));
  }
  const double ratio = s.radial / axial;
  return Slice{ratio, die.wall_length / s.height * loss / ratio};
}

struct Column {
  std::vector<double> density, ratio, friction;
  SliceState mean;
};

// The value of a fitted line in the middle of the samples, and its standard error.
struct Middle {
  double value = 0, error = 0, freedom = 1;
};
Middle middle_of(const std::vector<double>& x, const std::vector<double>& y) {
  const Line line = fit_line(x, y);
  const auto n = static_cast<double>(x.size());
  double neighbours = 0, before = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double rest = y[i] - line.at(x[i]);
    if (i > 0) neighbours += rest * before;
    before = rest;
  }
  const double r = line.residual > 0 ? std::clamp(neighbours / line.residual, 0.0, 0.99) : 0;
  const double fewer = (1 + r) / (1 - r);
  return {line.value, std::sqrt(line.residual / (n - 2) / n * fewer), std::max(1.0, n / fewer - 2)};
}

void add_changes(SliceStep& step, const SliceState& mean, const DieCurve& die,
                 const Settings& settings) {
  const auto plain = slice_of(mean, die);
  const auto add = [&](const char* source, double error, SliceState changed) {
    if (!(error > 0)) return;
    const auto other = slice_of(changed, die);
    const auto change = [&](double Slice::*what, double value) {
      return plain && other ? std::abs((*other).*what - (*plain).*what) : std::abs(value);
    };
    step.stress_ratio.contributions.push_back(
        {source, change(&Slice::stress_ratio, step.stress_ratio.value)});
    step.friction.contributions.push_back({source, change(&Slice::friction, step.friction.value)});
  };
  const GaugesSpec& g = settings.gauges;
  const auto changed = [&](double SliceState::*what, double factor) {
    SliceState other = mean;
    other.*what *= factor;
    return other;
  };
  add("top", g.top_error, changed(&SliceState::top, 1 + g.top_error));
  add("bottom", g.bottom_error, changed(&SliceState::bottom, 1 + g.bottom_error));
  add("radial", g.radial_error, changed(&SliceState::radial, 1 + g.radial_error));
  const double height = settings.die.height_error;
  add("height", height, changed(&SliceState::height, 1 + height / mean.height));
}

SliceStep step_of(const Column& column, const DieCurve& die, const Settings& settings,
                  bool is_measured) {
  SliceStep step;
  step.samples = column.density.size();
  for (const double d : column.density) step.density += d / static_cast<double>(step.samples);
  step.top = column.mean.top;
  step.bottom = column.mean.bottom;
  const Middle ratio = middle_of(column.density, column.ratio);
  const Middle friction = middle_of(column.density, column.friction);
  step.stress_ratio = {"K", "-", ratio.value, ratio.freedom, {{"scatter", ratio.error}}};
  step.friction = {
      "friction", "-", friction.value, friction.freedom, {{"scatter", friction.error}}};
  if (is_measured) add_changes(step, column.mean, die, settings);
  return step;
}

void check_gauge(const DieCurve& die, const Settings& settings) {
  if (!die.radial_height) return;
  const double largest = std::ranges::max(die.top);
  double highest = 0;  // compact that is evaluated
  for (std::size_t i = 0; i < die.height.size(); ++i)
    if (die.top[i] >= settings.gauges.from * largest) highest = std::max(highest, die.height[i]);
  if (*die.radial_height > highest)
    throw SceneError(
        {{settings.file.string(), 1, 1, "", "gauges.radial_height",
          fmt::format("{:.4g} mm is above the compact, which is at most {:.4g} mm high where it is "
                      "evaluated, allowed: up to that",
                      *die.radial_height * 1e3, highest * 1e3)}});
}

}  // namespace

DieCurve die_curve(const DieRecord& record, const TransmissionSpec& spec, const Settings& settings,
                   const Compliance& machine) {
  const PressCurve press = press_curve(record, spec, settings.die, settings.compression, machine);
  check_density(record, press, settings.die);
  DieCurve die{
      spec.name, {}, {}, {}, {}, {}, settings.die.wall_length(), settings.gauges.radial_height, {}};
  for (std::size_t i = 0; i <= press.peak; ++i) {
    die.density.push_back(press.density[i]);
    die.top.push_back(press.pressure[i]);
    die.bottom.push_back(record.bottom[press.first + i] / settings.die.area());
    die.radial.push_back(record.radial[press.first + i]);
    die.height.push_back(press.height[i]);
  }
  check_gauge(die, settings);
  return die;
}

DieCurve simulated_die(const std::filesystem::path& run_folder) {
  const Scene scene = load_scene(run_folder / "scene.toml").scene;
  const CompactionCurve names(scene);
  const csv::Table history = history_of_run(run_folder);
  if (!names.has_die())
    csv::refuse(history, "stress/axial_top",
                "the run has no die of four plane tools, allowed: a compaction in such a die");
  const auto series = [&](const std::string& name, const char* unit) {
    return csv::numbers(history, csv::column_at(history, name), unit);
  };
  const auto place = [&](const std::string& tool, const char* axis) {
    return series("tool/" + tool + "/position_" + axis, "m");
  };
  const auto density = series("relative_density", "");
  const auto top = series("stress/axial_top", "Pa"), bottom = series("stress/axial_bottom", "Pa");
  const auto left = series("stress/radial_left", "Pa"), right = series("stress/radial_right", "Pa");
  const auto high = place(names.top(), "y"), low = place(names.bottom(), "y");
  const double width = place(names.right(), "x").front() - place(names.left(), "x").front();
  DieCurve die{name_of_run(run_folder), {}, {}, {}, {}, {}, width / 2, {}, wall_friction(scene)};
  const auto last = static_cast<std::size_t>(std::ranges::max_element(density) - density.begin());
  for (std::size_t i = 0; i <= last; ++i) {
    die.density.push_back(density[i]);
    die.top.push_back(top[i]);
    die.bottom.push_back(bottom[i]);
    die.radial.push_back((left[i] + right[i]) / 2);
    die.height.push_back(high[i] - low[i]);
  }
  return die;
}

std::vector<SliceStep> slice_steps(const DieCurve& curve, const Settings& settings,
                                   bool is_measured) {
  const GaugesSpec& gauges = settings.gauges;
  const double largest = std::ranges::max(curve.top);
  std::map<long, Column> columns;  // by step number
  for (std::size_t i = 0; i < curve.density.size(); ++i) {
    const SliceState state{curve.top[i], curve.bottom[i], curve.radial[i], curve.height[i]};
    const auto slice = slice_of(state, curve);
    if (!slice || curve.top[i] < gauges.from * largest) continue;
    Column& column = columns[std::lround(curve.density[i] / gauges.density_step)];
    column.density.push_back(curve.density[i]);
    column.ratio.push_back(slice->stress_ratio);
    column.friction.push_back(slice->friction);
    const auto n = static_cast<double>(column.density.size());
    for (double SliceState::*what :
         {&SliceState::top, &SliceState::bottom, &SliceState::radial, &SliceState::height})
      column.mean.*what += (state.*what - column.mean.*what) / n;
  }
  std::vector<SliceStep> steps;
  for (const auto& [number, column] : columns)
    if (column.density.size() >= fewest_in_step && column.density.front() != column.density.back())
      steps.push_back(step_of(column, curve, settings, is_measured));
  return steps;
}

}  // namespace pulvis::lab
