#include "cli/laboratory/output/die_output.hpp"

#include <fmt/format.h>

#include "cli/csv_cell.hpp"
#include "cli/laboratory/lab_die.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

struct DieResult {
  lab::DieCurve curve;
  std::vector<lab::SliceStep> steps;
  bool is_measured = true;
  double confidence = 0;

  std::string label() const { return is_measured ? curve.name : "simulation " + curve.name; }
};

std::vector<DieResult> results_of(const lab::LoadedSettings& loaded,
                                  const std::vector<std::filesystem::path>& simulations) {
  const lab::Settings& settings = loaded.settings;
  const lab::Compliance machine = lab::machine_of(settings);
  std::vector<DieResult> all;
  const auto add = [&](lab::DieCurve curve, bool is_measured) {
    DieResult result{std::move(curve), {}, is_measured, settings.analysis.confidence};
    result.steps = lab::slice_steps(result.curve, settings, is_measured);
    all.push_back(std::move(result));
  };
  for (const lab::TransmissionSpec& spec : settings.transmissions)
    add(lab::die_curve(lab::read_die(settings.file.parent_path() / spec.record, settings), spec,
                       settings, machine),
        true);
  for (const auto& run : simulations) add(lab::simulated_die(run), false);
  return all;
}

std::string slices_csv(const std::vector<DieResult>& all) {
  std::string text =
      "name,is_simulated [-],relative_density [-],axial_top [Pa],axial_bottom [Pa],stress_ratio "
      "[-],stress_ratio_half_width [-],friction [-],friction_half_width [-],samples [-]\n";
  for (const DieResult& one : all)
    for (const lab::SliceStep& step : one.steps)
      text += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.4g},{:.9g},{:.4g},{}\n",
                          csv_word(one.curve.name), one.is_measured ? 0 : 1, step.density, step.top,
                          step.bottom, step.stress_ratio.value,
                          step.stress_ratio.half_width(one.confidence), step.friction.value,
                          step.friction.half_width(one.confidence), step.samples);
  return text;
}

Json slices_json(const std::vector<DieResult>& all) {
  Json json{{"kind", "transmission"}, {"dies", Json::array()}};
  for (const DieResult& one : all) {
    json["confidence"] = one.confidence;
    Json die{{"name", one.curve.name},
             {"is_simulated", !one.is_measured},
             {"wall_length", one.curve.wall_length}};
    if (one.curve.friction) die["friction_of_scene"] = *one.curve.friction;
    die["steps"] = Json::array();
    for (const lab::SliceStep& step : one.steps)
      die["steps"].push_back({{"relative_density", step.density},
                              {"axial_top", step.top},
                              {"axial_bottom", step.bottom},
                              {"samples", step.samples},
                              {"stress_ratio", measured_json(step.stress_ratio, one.confidence)},
                              {"friction", measured_json(step.friction, one.confidence)}});
    json["dies"].push_back(die);
  }
  return json;
}

Json steps_chart(const std::vector<DieResult>& all, const std::string& title, const char* y,
                 lab::Measured lab::SliceStep::*figure) {
  Json chart = chart_of(title, "relative density", "-", y);
  for (const DieResult& one : all) {
    std::vector<double> x, values;
    Json low = Json::array(), high = Json::array();
    for (const lab::SliceStep& step : one.steps) {
      const double half = (step.*figure).half_width(one.confidence);
      x.push_back(step.density);
      values.push_back((step.*figure).value);
      low.push_back(values.back() - half);
      high.push_back(values.back() + half);
    }
    Json line = chart_line(one.label(), "-", x, values);
    line["isMarks"] = true;
    line["low"] = low;
    line["high"] = high;
    chart["lines"].push_back(line);
  }
  return chart;
}

Json stresses_chart(const DieResult& one) {
  Json chart = chart_of("Stresses of " + one.label(), "relative density", "-", "stress");
  const lab::DieCurve& c = one.curve;
  chart["lines"].push_back(chart_line("axial, top", "Pa", c.density, c.top));
  chart["lines"].push_back(chart_line("axial, bottom", "Pa", c.density, c.bottom));
  chart["lines"].push_back(chart_line("radial", "Pa", c.density, c.radial));
  return chart;
}

Json steps_table(const DieResult& one) {
  Json table{{"title", one.label()},
             {"head", {"relative density", "axial top", "axial bottom", "K", "friction"}},
             {"rows", Json::array()}};
  for (const lab::SliceStep& step : one.steps)
    table["rows"].push_back({step.density, Json{{"value", step.top}, {"unit", "Pa"}},
                             Json{{"value", step.bottom}, {"unit", "Pa"}},
                             measured_cell(step.stress_ratio, one.confidence),
                             measured_cell(step.friction, one.confidence)});
  table["note"] = fmt::format(
      "± is the half width of the {:g} % interval. The friction is the mobilised one: where the "
      "powder sticks to the wall it is below the coefficient{}.",
      100 * one.confidence,
      one.curve.friction ? fmt::format(" ({:g} at the walls of the scene)", *one.curve.friction)
                         : "");
  return table;
}

std::string slices_text(const std::vector<DieResult>& all) {
  std::string text;
  for (const DieResult& one : all) {
    text += one.label() + ":\n";
    if (one.steps.empty()) text += "  no density step has enough samples\n";
    for (const lab::SliceStep& step : one.steps)
      text += fmt::format("  density {:.4f}: {}, {}\n", step.density,
                          measured_text(step.stress_ratio, one.confidence),
                          measured_text(step.friction, one.confidence));
  }
  return text;
}

}  // namespace

LabOutput die_output(const lab::LoadedSettings& loaded,
                     const std::vector<std::filesystem::path>& simulations) {
  const std::vector<DieResult> all = results_of(loaded, simulations);
  const std::string& named = loaded.settings.title;
  LabOutput output;
  output.title = named.empty() ? "Instrumented die" : named;
  output.lead =
      "Wall friction and stress ratio K from the force balance on a slice of the compact: the "
      "axial stress decays exponentially from the top punch to the bottom punch.";
  output.summary = slices_json(all);
  output.files.emplace_back("slices.csv", slices_csv(all));
  output.charts.push_back(steps_chart(all, "Stress ratio K", "radial over axial stress",
                                      &lab::SliceStep::stress_ratio));
  output.charts.push_back(
      steps_chart(all, "Wall friction", "friction coefficient", &lab::SliceStep::friction));
  for (const DieResult& one : all) output.charts.push_back(stresses_chart(one));
  for (const DieResult& one : all) output.tables.push_back(steps_table(one));
  output.told = slices_text(all);
  return output;
}

}  // namespace pulvis
