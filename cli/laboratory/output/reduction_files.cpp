#include "cli/laboratory/output/reduction_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/csv_cell.hpp"
#include "cli/save_scene.hpp"
#include "cli/summary.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

std::string curves_csv(const Reduction& reduction) {
  const lab::AnalysisSpec& analysis = reduction.loaded.settings.analysis;
  const double step = analysis.distance_step;
  std::vector<std::string> names{"distance [m]", "mean [-]", "deviation [-]", "half_width [-]"};
  std::vector<std::vector<double>> values(4);
  for (const lab::Sample& sample : reduction.over_runs.friction) {
    values[1].push_back(sample.mean);
    values[2].push_back(sample.deviation);
    if (const auto half = lab::half_width(sample, analysis.confidence)) values[3].push_back(*half);
  }
  for (const lab::ReducedRun& run : reduction.runs) {
    names.push_back("run/" + run.name + " [-]");
    values.push_back(lab::on_grid(run.curve.distance, run.curve.friction, step));
  }
  for (const lab::SimulatedCurve& simulation : reduction.simulations) {
    names.push_back("simulation/" + simulation.name + " [-]");
    values.push_back(lab::on_grid(simulation.distance, simulation.friction, step));
  }
  std::size_t rows = 0;
  for (const auto& column : values) rows = std::max(rows, column.size());
  for (std::size_t i = 0; i < rows; ++i) values[0].push_back(static_cast<double>(i) * step);
  std::vector<CsvColumn> columns;
  for (std::size_t i = 0; i < names.size(); ++i) columns.push_back({names[i], &values[i]});
  return csv_columns(columns);
}

Json clock_json(const lab::Clocks& clocks) {
  Json json{{"offset", clocks.offset},
            {"offset_uncertainty", clocks.offset_uncertainty},
            {"found_from", clocks.is_given ? "given" : "start of sliding"},
            {"start_on_press_clock", clocks.press_start.time},
            {"start_on_logger_clock", clocks.logger_start.time}};
  if (clocks.drift) json["drift"] = *clocks.drift;
  if (clocks.drift) json["drift_uncertainty"] = clocks.drift_uncertainty;
  json["drift_is_applied"] = clocks.is_drift_applied;
  return json;
}

Json stick_slip_json(const lab::StickSlip& s) {
  return {{"slips", s.slips},
          {"amplitude", s.amplitude},
          {"amplitude_deviation", s.amplitude_deviation},
          {"amplitude_resolution", s.resolution},
          {"shear_force_amplitude", s.force},
          {"period", s.period},
          {"period_deviation", s.period_deviation},
          {"period_time", s.period_time},
          {"spectral_period", s.spectral_period}};
}

Json sample_json(const lab::Sample& sample, double confidence) {
  if (sample.count == 0) return nullptr;
  Json json{{"count", sample.count}, {"mean", sample.mean}};
  if (sample.count > 1) json["deviation"] = sample.deviation;
  if (const auto half = lab::half_width(sample, confidence)) json["half_width"] = *half;
  return json;
}

}  // namespace

std::string run_csv(const lab::Curve& curve) {
  return csv_columns({{"time [s]", &curve.time},
                      {"distance [m]", &curve.distance},
                      {"shear_force [N]", &curve.shear_force},
                      {"punch_force [N]", &curve.punch_force},
                      {"punch_travel [m]", &curve.punch_travel},
                      {"compact_length [m]", &curve.length},
                      {"target_force [N]", &curve.target_force},
                      {"friction [-]", &curve.friction}});
}

nlohmann::ordered_json run_json(const lab::ReducedRun& run) {
  const lab::Curve& curve = run.curve;
  Json json{{"name", run.name},
            {"press", run.press.string()},
            {"logger", run.logger.string()},
            {"clock", clock_json(run.clocks)},
            {"sliding_distance", curve.distance.back()},
            {"sliding_speed", run.speed},
            {"plate_stops_within_record", run.has_end},
            {"punch_force", lab::sample_of(curve.punch_force).mean},
            {"target_force", lab::sample_of(curve.target_force).mean},
            {"shear_force", lab::sample_of(curve.shear_force).mean},
            {"shear_zero", run.shear_zero},
            {"noise", run.noise},
            {"static_friction", run.peak.value},
            {"static_distance", run.peak.distance},
            {"static_is_distinct", run.peak.is_distinct},
            {"dynamic_friction", run.dynamic.mean},
            {"dynamic_deviation", run.dynamic.deviation},
            {"dynamic_trend", run.dynamic.trend},
            {"dynamic_from", run.dynamic.from},
            {"dynamic_until", run.dynamic.until}};
  if (run.elastic_dynamic) json["elastic_dynamic_friction"] = *run.elastic_dynamic;
  if (run.stick_slip)
    json["stick_slip"] = stick_slip_json(*run.stick_slip);
  else
    json["stick_slip"] = nullptr;
  return json;
}

nlohmann::ordered_json reduction_json(const Reduction& reduction) {
  const lab::Settings& settings = reduction.loaded.settings;
  const double confidence = settings.analysis.confidence;
  const lab::Repeatability& over = reduction.over_runs;
  Json runs = Json::array(), simulations = Json::array();
  for (const lab::ReducedRun& run : reduction.runs) runs.push_back(run_json(run));
  for (const lab::SimulatedCurve& s : reduction.simulations) simulations.push_back(s.name);
  return {{"title", settings.title},
          {"version", program_version()},
          {"commit", program_commit()},
          {"confidence", confidence},
          {"static_friction", sample_json(over.peak, confidence)},
          {"dynamic_friction", sample_json(over.dynamic, confidence)},
          {"stick_slip_amplitude", sample_json(over.amplitude, confidence)},
          {"stick_slip_period", sample_json(over.period, confidence)},
          {"runs", runs},
          {"simulations", simulations}};
}

void write_reduction(const std::filesystem::path& folder, const Reduction& reduction) {
  for (const lab::ReducedRun& run : reduction.runs)
    write_own(folder / ("reduced-" + run.name + ".csv"), role::reduction, run_csv(run.curve));
  write_own(folder / "curves.csv", role::reduction, curves_csv(reduction));
  save_inputs(folder, reduction.loaded.inputs);
  write_own(folder / "reduce.toml", role::reduction, reduction.loaded.text);
  const Json json = reduction_json(reduction);
  write_own(folder / "summary.json", role::reduction,
            json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace pulvis
