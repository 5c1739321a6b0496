#include "cli/laboratory/lab_compression.hpp"

#include "cli/laboratory/lab_simulation.hpp"
#include "scenes/language/csv_table.hpp"
#include "scenes/results/density_fit_errors.hpp"
#include "scenes/solve/lab_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulvis::lab {
namespace {

// A change of the reduction's inputs by one standard uncertainty.
struct Change {
  std::string source;
  Filling filling;
  Compliance machine;
};

std::vector<Change> changes_of(const PressRecord& record, const CurveSpec& spec,
                               const Settings& settings, const Compliance& machine) {
  std::vector<Change> changes;
  if (const double error = settings.die.height_error; error > 0) {
    Change change{"height", spec, machine};
    if (change.filling.fill_height) *change.filling.fill_height += error;
    if (change.filling.final_height) *change.filling.final_height += error;
    if (change.machine.meeting) *change.machine.meeting += error;
    changes.push_back(change);
  }
  if (const double error = settings.die.mass_error; error > 0) {
    Change change{"mass", spec, machine};
    change.filling.mass *= 1 + error;
    changes.push_back(change);
  }
  if (const double error = settings.compression.compliance_error; error > 0) {
    Change change{"compliance", spec, machine};
    for (double& c : change.machine.coefficients) c *= 1 + error;
    changes.push_back(change);
  }
  for (const Compliance::Error& error : machine.errors) {
    Change change{"empty press", spec, machine};
    *change.machine.meeting += error.meeting;
    for (std::size_t k = 0; k < error.coefficients.size(); ++k)
      change.machine.coefficients[k] += error.coefficients[k];
    changes.push_back(change);
  }
  if (spec.final_height) {
    Change change{"last sample", spec, machine};
    *change.filling.final_height += displacement_noise(record);
    changes.push_back(change);
  }
  return changes;
}

FitRange range_of(const PressCurve& curve, const CurveSpec& spec, const CompressionSpec& c) {
  const double largest = curve.pressure[curve.peak];
  return range_between(spec.initial_density.value_or(curve.density.front()),
                       curve.loading_density(), curve.loading_pressure(),
                       c.fit_from.value_or(min_pressure_share * largest),
                       c.fit_until.value_or(largest));
}

// If a law no longer fits the changed curve, or only with fewer terms, the whole value is uncertain. A value at its
// bound stays there whatever it is worth.
double change_of(const DensityFit& changed, const DensityFit& fit, std::size_t parameter) {
  if (fit.parameters[parameter].is_at_bound) return std::numeric_limits<double>::infinity();
  const double value = fit.parameters[parameter].value;
  if (changed.parameters.size() != fit.parameters.size()) return std::abs(value);
  return std::abs(changed.parameters[parameter].value - value);
}

// In quadrature with what the same source has contributed so far.
void add_contribution(Measured& to, const std::string& source, double error) {
  const auto same = std::ranges::find(to.contributions, source, &Contribution::source);
  if (same == to.contributions.end())
    to.contributions.push_back({source, error});
  else
    same->error = std::sqrt(same->error * same->error + error * error);  // infinite stays infinite
}

std::vector<LawFit> laws_of(const FitRange& range) {
  std::vector<LawFit> laws;
  for (const DensityFit& fit : fit_all(range)) {
    LawFit law{fit, {}};
    if (fit.not_fitted.empty()) {
      const FitErrors errors = fit_errors(fit, range);
      for (std::size_t i = 0; i < fit.parameters.size(); ++i)
        law.parameters.push_back({fit.parameters[i].name,
                                  fit.parameters[i].unit,
                                  fit.parameters[i].value,
                                  errors.freedom,
                                  {{"scatter", errors.standard[i]}}});
    }
    laws.push_back(std::move(law));
  }
  return laws;
}

// A curve that can be looked up by x: samples where x increases, both values positive.
struct Growing {
  std::vector<double> x, y;
};
Growing growing(std::span<const double> x, std::span<const double> y) {
  Growing kept;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] > 0) || !(y[i] > 0) || (!kept.x.empty() && x[i] <= kept.x.back())) continue;
    kept.x.push_back(x[i]);
    kept.y.push_back(y[i]);
  }
  return kept;
}

}  // namespace

ReducedCurve reduce_curve(const PressRecord& record, const CurveSpec& spec,
                          const Settings& settings, const Compliance& machine) {
  const CompressionSpec& c = settings.compression;
  ReducedCurve reduced{spec.name, record.file, {}, {}, {}, {}};
  reduced.curve = press_curve(record, spec, settings.die, c, machine);
  check_density(record, reduced.curve, settings.die);
  reduced.unloading = unloading_of(reduced.curve);
  reduced.range = range_of(reduced.curve, spec, c);
  reduced.laws = laws_of(reduced.range);
  for (const Change& change : changes_of(record, spec, settings, machine)) {
    const PressCurve curve = press_curve(record, change.filling, settings.die, c, change.machine);
    const std::vector<DensityFit> fits = fit_all(range_of(curve, spec, c));
    for (std::size_t l = 0; l < fits.size(); ++l)
      for (std::size_t i = 0; i < reduced.laws[l].parameters.size(); ++i)
        add_contribution(reduced.laws[l].parameters[i], change.source,
                         change_of(fits[l], reduced.laws[l].fit, i));
  }
  return reduced;
}

std::vector<OverCurves> over_curves(const std::vector<ReducedCurve>& curves) {
  std::vector<OverCurves> all;
  for (std::size_t l = 0; l < curves.front().laws.size(); ++l) {
    std::vector<std::string> names;  // in the order of the law's parameters
    std::vector<std::vector<double>> values;
    std::vector<OverCurves> found;
    for (const ReducedCurve& curve : curves)
      for (const Measured& p : curve.laws[l].parameters) {
        if (!p.has_interval()) continue;  // a bound is not a result
        const auto at = static_cast<std::size_t>(std::ranges::find(names, p.name) - names.begin());
        if (at == names.size()) {
          names.push_back(p.name);
          values.emplace_back();
          found.push_back({curve.laws[l].fit.law, p.name, p.unit, {}});
        }
        values[at].push_back(p.value);
      }
    for (std::size_t i = 0; i < found.size(); ++i) {
      found[i].sample = sample_of(values[i]);
      all.push_back(found[i]);
    }
  }
  return all;
}

SimulatedCompression read_compression(const std::filesystem::path& run_folder,
                                      const SimulationSpec& spec) {
  const csv::Table history = history_of_run(run_folder);
  const auto series = [&](const std::string& name, const char* key, const char* unit) {
    if (!csv::has_column(history, name))
      csv::refuse(
          history, std::string("simulation.") + key,
          fmt::format(
              "the run has no series '{}', allowed: the name of a series in its history.csv",
              name));
    return csv::numbers(history, csv::column_at(history, name), unit);
  };
  const std::vector<double> density = series(spec.density, "density", "");
  std::vector<double> pressure = series(spec.pressure, "pressure", "Pa");
  const auto largest = std::ranges::max_element(pressure, {}, [](double p) { return std::abs(p); });
  if (largest != pressure.end() && *largest < 0)
    for (double& p : pressure) p = -p;
  const auto last = static_cast<std::size_t>(std::ranges::max_element(density) - density.begin());
  const Growing loading =
      growing(std::span(density).first(last + 1), std::span(pressure).first(last + 1));
  if (loading.x.size() < 2)
    csv::refuse(history, spec.pressure, "shows no loading, allowed: a run that is compacted");
  return {name_of_run(run_folder), loading.x, loading.y};
}

CompressionMisfit misfit_of(const SimulatedCompression& simulated, const ReducedCurve& measured) {
  constexpr int places = 100;
  CompressionMisfit misfit{simulated.name, measured.name, "", 0, 0, 0, 0, 0};
  const auto density = measured.curve.loading_density();
  const auto pressure = measured.curve.loading_pressure();
  const Growing m = growing(density, pressure), by_pressure = growing(pressure, density);
  misfit.from = std::max(m.x.front(), simulated.density.front());
  misfit.until = std::min(m.x.back(), simulated.density.back());
  if (!(misfit.until > misfit.from)) {
    misfit.not_compared =
        fmt::format("measured at densities from {:.4g} to {:.4g}, simulated from {:.4g} to {:.4g}",
                    m.x.front(), m.x.back(), simulated.density.front(), simulated.density.back());
    return misfit;
  }
  double squares = 0, densities = 0;
  for (int i = 0; i <= places; ++i) {
    const double d = misfit.from + (misfit.until - misfit.from) * i / places;
    const double p = interpolated(m.x, m.y, d);
    const double ratio = std::log(interpolated(simulated.density, simulated.pressure, d) / p);
    misfit.log_pressure += ratio / (places + 1);
    squares += ratio * ratio / (places + 1);
    const double same = interpolated(by_pressure.x, by_pressure.y, p * std::exp(ratio));
    densities += (same - d) * (same - d) / (places + 1);
  }
  misfit.rms_log_pressure = std::sqrt(squares);
  misfit.rms_density = std::sqrt(densities);
  return misfit;
}

}  // namespace pulvis::lab
