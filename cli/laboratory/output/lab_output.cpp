#include "cli/laboratory/output/lab_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "cli/report/report_page.hpp"
#include "cli/save_scene.hpp"
#include "cli/summary.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_points = 1000;  // per line of a chart

std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::vector<std::string> LabOutput::names() const {
  std::vector<std::string> all{"reduce.toml", "summary.json", "report.html"};
  for (const auto& [name, text] : files) all.push_back(name);
  return all;
}

void write_lab(const std::filesystem::path& folder, const LabOutput& output,
               const lab::LoadedSettings& loaded) {
  for (const auto& [name, text] : output.files) write_own(folder / name, role::reduction, text);
  save_inputs(folder, loaded.inputs);
  write_own(folder / "reduce.toml", role::reduction, loaded.text);
  Json summary{
      {"title", output.title}, {"version", program_version()}, {"commit", program_commit()}};
  summary.update(output.summary);
  write_own(folder / "summary.json", role::reduction, text_of(summary, 2) + "\n");
  write_lab_page(folder, output, loaded.text, role::reduction);
}

void write_lab_page(const std::filesystem::path& folder, const LabOutput& output,
                    const std::string& settings, const char* role) {
  const Json head{{"lead", output.lead},          {"charts", output.charts},
                  {"tables", output.tables},      {"settings", settings},
                  {"version", program_version()}, {"commit", program_commit()},
                  {"values", output.values}};
  write_page(folder / "report.html", "lab.html",
             {"units.js", "payload.js", "save.js", "chart.js", "tables.js", "lab.js"},
             {output.title, text_of(head, -1), {}}, role);
}

nlohmann::ordered_json chart_line(const std::string& label, const char* unit,
                                  std::span<const double> x, std::span<const double> y) {
  Json xs = Json::array(), ys = Json::array();
  const std::size_t count = std::min(x.size(), most_points);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = count == 1 ? 0 : i * (x.size() - 1) / (count - 1);
    xs.push_back(x[at]);
    ys.push_back(y[at]);
  }
  return {{"label", label}, {"unit", unit}, {"x", xs}, {"values", ys}};
}

nlohmann::ordered_json chart_of(const std::string& title, const char* x_label, const char* x_unit,
                                const char* y_label) {
  return {{"title", title},
          {"x", {{"label", x_label}, {"unit", x_unit}}},
          {"y", y_label},
          {"lines", Json::array()}};
}

nlohmann::ordered_json measured_cell(const lab::Measured& figure, double confidence) {
  Json cell{{"value", figure.value}, {"unit", figure.unit}};
  if (figure.has_interval()) cell["error"] = figure.half_width(confidence);
  return cell;
}

// nlohmann::json writes infinite numbers as null.
nlohmann::ordered_json measured_json(const lab::Measured& figure, double confidence) {
  Json json{{"name", figure.name},
            {"unit", figure.unit},
            {"value", figure.value},
            {"half_width", figure.half_width(confidence)},
            {"standard_uncertainty", figure.standard()}};
  for (const lab::Contribution& c : figure.contributions) json["of"][c.source] = c.error;
  return json;
}

std::string for_page(std::string text) {
  std::ranges::replace(text, '_', ' ');
  for (std::size_t at; (at = text.find("+-")) != std::string::npos;) text.replace(at, 2, "±");
  return text;
}

std::string measured_text(const lab::Measured& figure, double confidence) {
  double factor = 1;
  std::string unit = figure.unit == "-" ? "" : " " + figure.unit;
  if (figure.unit == "Pa") factor = 1e-6, unit = " MPa";
  if (figure.unit == "1/Pa") factor = 1e6, unit = " 1/MPa";
  if (!figure.has_interval())
    return fmt::format("{} {:.5g}{} (no interval)", figure.name, figure.value * factor, unit);
  return fmt::format("{} {:.5g} +- {:.2g}{}", figure.name, figure.value * factor,
                     figure.half_width(confidence) * factor, unit);
}

}  // namespace pulvis
