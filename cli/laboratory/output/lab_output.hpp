// Output files of a reduction of laboratory records: tables (CSV), summary.json, report.html, and the
// settings with copies of the records. Each kind of record produces one of these.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/laboratory/lab_settings.hpp"
#include "cli/laboratory/lab_uncertainty.hpp"

namespace pulvis {

struct LabOutput {
  nlohmann::ordered_json summary;                          // SI units
  std::vector<std::pair<std::string, std::string>> files;  // name and text
  std::string title, lead;                                 // of the page
  std::string values = "summary.json";                     // the file that the page refers to
  nlohmann::ordered_json charts = nlohmann::ordered_json::array();
  nlohmann::ordered_json tables = nlohmann::ordered_json::array();
  std::string told;  // printed on the command line

  std::vector<std::string> names() const;  // of all files to be written, including the settings
};

void write_lab(const std::filesystem::path& folder, const LabOutput& output,
               const lab::LoadedSettings& loaded);

// Only the page, with the settings shown on it.
void write_lab_page(const std::filesystem::path& folder, const LabOutput& output,
                    const std::string& settings, const char* role);

// A line of a chart, thinned to the visible resolution.
nlohmann::ordered_json chart_line(const std::string& label, const char* unit,
                                  std::span<const double> x, std::span<const double> y);
nlohmann::ordered_json chart_of(const std::string& title, const char* x_label, const char* x_unit,
                                const char* y_label);

// {value, error, unit} as a table cell of the page; the error is the half-width of the interval, if there is one.
nlohmann::ordered_json measured_cell(const lab::Measured& figure, double confidence);
// The same with all contributions, for summary.json; without an interval they are null.
nlohmann::ordered_json measured_json(const lab::Measured& figure, double confidence);
// "yield_pressure 420.1 +- 0.8 MPa" with the most readable prefix, "yield_pressure 420.1 MPa (no interval)".
std::string measured_text(const lab::Measured& figure, double confidence);

// Such text and names of parameters as the page writes them: "yield pressure 420.1 ± 0.8 MPa".
std::string for_page(std::string text);

}  // namespace pulvis
