#include "cli/campaigns/fit/fit_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/laboratory/output/lab_output.hpp"
#include "cli/summary.hpp"
#include "engine/files/own_files.hpp"
#include "scenes/language/counted.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

const char* state_text(GaussNewton::State state) {
  return state == GaussNewton::State::converged ? "converged" : "gave up";
}

Json fit_json(const FitResult& r) {
  const PlateComparison& c = r.comparison;
  Json json{{"title", r.fit.spec.title},   {"version", program_version()},
            {"commit", program_commit()},  {"state", state_text(r.search.state())},
            {"rounds", r.search.rounds()}, {"confidence", r.fit.spec.confidence}};
  for (const lab::Measured& p : r.parameters)
    json["parameters"].push_back(measured_json(p, r.fit.spec.confidence));
  json["best_run"] = r.best().run;
  json["misfit_rms"] = r.best().misfit;
  if (c.has_record())
    json["compared"] = {{"from", c.from()}, {"until", c.until()}, {"samples", c.compared()}};
  json["simulated_static"] = static_coefficient(r.best().curve, r.fit.spec.static_within);
  if (r.fit.spec.dynamic_from < r.best().curve.distance.back())
    json["simulated_dynamic"] = dynamic_coefficient(r.best().curve, r.fit.spec.dynamic_from);
  json["limits"] = c.limits();
  json["warnings"] = r.warnings;
  return json;
}

std::string trials_csv(const FitResult& r) {
  std::string text = "run";
  for (const lab::Measured& p : r.parameters) text += fmt::format(",{} [{}]", p.name, p.unit);
  text += ",misfit [-]\n";
  for (const FitTrial& trial : r.trials) {
    text += "\"" + trial.run + "\"";
    for (std::size_t k = 0; k < trial.values.size(); ++k)
      text += "," + r.fit.spec.parameters[k].text(trial.values[k]);
    text += fmt::format(",{:.6g}\n", trial.misfit);
  }
  return text;
}

Json curves_chart(const FitResult& r) {
  const PlateComparison& c = r.comparison;
  Json chart =
      chart_of("Friction against the simulated distance", "distance", "m", "friction coefficient");
  if (c.has_record()) {
    const auto shown = static_cast<std::size_t>(
        std::ranges::upper_bound(c.distance(), 1.5 * c.until()) - c.distance().begin());
    chart["lines"].push_back(chart_line("measured", "-", std::span(c.distance()).first(shown),
                                        std::span(c.friction()).first(shown)));
  }
  Json best =
      chart_line("simulated, fitted", "-", r.best().curve.distance, r.best().curve.friction);
  best["isSimulated"] = true;
  chart["lines"].push_back(best);
  chart["lines"].push_back(chart_line("simulated, first run", "-", r.trials.front().curve.distance,
                                      r.trials.front().curve.friction));
  if (c.has_record())
    chart["note"] =
        fmt::format("Compared from {:.4g} to {:.4g} mm.", c.from() * 1e3, c.until() * 1e3);
  return chart;
}

Json misfit_chart(const FitResult& r, std::size_t parameter) {
  const std::string name = for_page(r.parameters[parameter].name);
  Json chart = chart_of("Misfit of all runs against " + name, name.c_str(),
                        r.parameters[parameter].unit.c_str(), "root mean square of the residuals");
  std::vector<double> x, y;
  for (const FitTrial& trial : r.trials) {
    x.push_back(trial.values[parameter]);
    y.push_back(trial.misfit);
  }
  Json line = chart_line("runs", "-", x, y);
  line["isMarks"] = true;
  line["low"] = y;
  line["high"] = y;
  chart["lines"].push_back(line);
  return chart;
}

Json parameters_table(const FitResult& r) {
  Json table{
      {"title", "Found"}, {"head", {"key", "value", "start", "range"}}, {"rows", Json::array()}};
  for (std::size_t k = 0; k < r.parameters.size(); ++k) {
    const SoughtKey& sought = r.fit.spec.parameters[k];
    table["rows"].push_back({sought.key, measured_cell(r.parameters[k], r.fit.spec.confidence),
                             sought.start, fmt::format("{:g} to {:g}", sought.low, sought.high)});
  }
  table["note"] =
      fmt::format("± is the half width of the {:g} % interval.", 100 * r.fit.spec.confidence);
  return table;
}

Json sentences_table(const std::string& title, const std::vector<std::string>& sentences) {
  Json table{{"title", title}, {"head", Json::array()}, {"rows", Json::array()}};
  for (const std::string& sentence : sentences) table["rows"].push_back({sentence});
  return table;
}

Json trials_table(const FitResult& r) {
  Json table{{"title", "Runs"}, {"head", {"run"}}, {"rows", Json::array()}};
  for (const lab::Measured& p : r.parameters) table["head"].push_back(for_page(p.name));
  table["head"].push_back("misfit");
  for (const FitTrial& trial : r.trials) {
    Json row{trial.run};
    for (const double value : trial.values) row.push_back(value);
    row.push_back(trial.misfit);
    table["rows"].push_back(row);
  }
  return table;
}

}  // namespace

const FitTrial& FitResult::best() const {
  return *std::ranges::find(trials, search.best(), &FitTrial::values);
}

void write_fit(const std::filesystem::path& folder, const FitResult& result) {
  write_own(folder / "trials.csv", role::fit, trials_csv(result));
  LabOutput page;
  page.title = result.fit.spec.title;
  page.lead = for_page(fit_text(result)) + ".";
  page.values = "fit.json";
  page.charts.push_back(curves_chart(result));
  for (std::size_t k = 0; k < result.parameters.size(); ++k)
    page.charts.push_back(misfit_chart(result, k));
  page.tables.push_back(parameters_table(result));
  page.tables.push_back(sentences_table("Range of valid comparison", result.comparison.limits()));
  if (!result.warnings.empty()) page.tables.push_back(sentences_table("Warnings", result.warnings));
  page.tables.push_back(trials_table(result));
  write_lab_page(folder, page, result.fit.text, role::fit);
  write_own(folder / "fit.json", role::fit,
            fit_json(result).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::string fit_text(const FitResult& result) {
  std::string text;
  for (const lab::Measured& p : result.parameters)
    text += measured_text(p, result.fit.spec.confidence) + "; ";
  return text + fmt::format("{} after {}, {}", state_text(result.search.state()),
                            counted(result.search.rounds(), "round"),
                            counted(result.trials.size(), "run"));
}

}  // namespace pulvis
