#include "cli/campaigns/study/study_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "cli/campaigns/study/analysis/study_series.hpp"
#include "cli/campaigns/study/study_peak.hpp"
#include "cli/campaigns/study/study_quality.hpp"
#include "cli/csv_cell.hpp"
#include "engine/files/hdf5.hpp"
#include "engine/files/input_file.hpp"
#include "scenes/checks/expect_checks.hpp"
#include "scenes/lever/afm_figures.hpp"
#include "scenes/results/results.hpp"
#include "scenes/tools/die_cell.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_summary = 64U << 20U;  // bytes

Json read_summary(const std::filesystem::path& folder) {
  try {
    Json json =
        Json::parse(text_of_input(folder / "summary.json", largest_summary), nullptr, false);
    return json.is_object() ? json : Json::object();
  } catch (const UnfitInput&) {
    return Json::object();
  }
}

std::string text_in(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

Json number_in(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? json[key] : Json();
}

bool ended_by_itself(const std::string& outcome) {
  return !outcome.empty() && outcome != "interrupted";
}

bool is_met(const Json& verdict) { return verdict.contains("met") && verdict["met"] == true; }

// "2 of 5"; nothing if the scene has no expectations.
std::string expectations_met(const Json& summary) {
  if (!summary.contains("expectations")) return "";
  const Json& all = summary["expectations"];
  const auto met = std::ranges::count_if(all, is_met);
  return fmt::format("{} of {}", met, all.size());
}

bool any_unmet(const Json& summary) {
  return summary.contains("expectations") &&
         std::ranges::any_of(summary["expectations"], std::not_fn(is_met));
}

Json largest(const std::vector<double>& values) {
  double maximum = -std::numeric_limits<double>::infinity();
  for (const double value : values)
    if (value > maximum) maximum = value;
  return std::isfinite(maximum) ? Json(maximum) : Json();
}

Json last(const std::vector<double>& values) {
  return values.empty() || !std::isfinite(values.back()) ? Json() : Json(values.back());
}

void add_forces(std::vector<Figure>& figures, const StudyResult& result) {
  const std::optional<DieCell> cell = die_cell(result.run->scene);
  if (!cell) return;
  const auto name = [&](int tool) {
    return result.run->scene.tools[static_cast<std::size_t>(tool)].name;
  };
  const std::string top = "tool/" + name(cell->top) + "/force_y";
  std::vector<double> below = result.series("tool/" + name(cell->bottom) + "/force_y");
  for (double& value : below) value = 0 - value;  // no -0 in a table
  figures.push_back({"top_force_end", "N", last(result.series(top))});
  figures.push_back({"bottom_force_end", "N", last(below)});
  figures.push_back({"top_force_max", "N", largest(result.series(top))});
  figures.push_back({"bottom_force_max", "N", largest(below)});
  figures.push_back(
      {"top_pressure_max", "Pa", largest(result.series("pressure/" + name(cell->top)))});
}

// Compaction laws: the fitted parameters of each, and its misfit.
void add_fits(std::vector<Figure>& figures, const StudyResult& result) {
  if (!result.summary.contains("fits")) return;
  for (const Json& law : result.summary["fits"]["laws"]) {
    const std::string name = law["law"].get<std::string>();
    if (!law.contains("parameters")) continue;
    for (const Json& p : law["parameters"])
      figures.push_back(
          {name + "_" + p["name"].get<std::string>(), p["unit"].get<std::string>(), p["value"]});
    figures.push_back({name + "_r_squared", "-", law["r_squared"]});
    figures.push_back({name + "_rms_density", "-", law["rms_density"]});
  }
}

void add_transmission(std::vector<Figure>& figures, const StudyResult& result) {
  const Json& summary = result.summary;
  if (!summary.contains("transmission") || !summary["transmission"].contains("shares")) return;
  const Json& share = summary["transmission"]["shares"].back();
  for (const char* name : {"measured", "round_die", "slot", "slot_measured_ratio"})
    figures.push_back({std::string("transmission_") + name, "-", number_in(share, name)});
}

void add_shear(std::vector<Figure>& figures, const Json& summary) {
  if (!summary.contains("shear")) return;
  for (const auto& [name, unit] :
       {std::pair{"static_friction", "-"}, {"dynamic_friction", "-"}, {"dilation", "m"}})
    figures.push_back({name, unit, number_in(summary["shear"], name)});
}

Json afm_figure(const Json& summary, const std::string& name) {
  return summary.contains("values") ? number_in(summary["values"], name.c_str()) : Json();
}

// Empty for a run that left no summary.
std::string quality_text(const StudyResult& result) {
  if (result.summary.empty()) return "";
  const std::vector<std::string> flags = quality_flags(result);
  return flags.empty() ? "within limits" : fmt::format("{}", fmt::join(flags, "; "));
}

std::vector<Figure> afm_figures_in(const StudyResult& result) {
  const Json& s = result.summary;
  std::vector<Figure> figures{{"outcome", "", text_in(s, "outcome")},
                              {"expectations_met", "", expectations_met(s)},
                              {"quality", "", quality_text(result)},
                              {"elements", "", number_in(s, "elements")},
                              {"increments", "", number_in(s, "increments")},
                              {"wall_seconds", "s", number_in(s, "wall_seconds")}};
  for (const SeriesInfo& info : afm_figures_of(result.run->scene))
    figures.push_back({info.name, info.unit, afm_figure(s, info.name)});
  figures.push_back({"scene_hash", "", text_in(s, "scene_hash")});
  figures.push_back({"commit", "", text_in(s, "commit")});
  return figures;
}

std::string cell_text(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return csv_word(value.get<std::string>());
  return value.is_number_float() ? fmt::format("{:.9g}", value.get<double>()) : value.dump();
}

}  // namespace

RunState state_of(const std::filesystem::path& folder, std::uint64_t scene_hash) {
  const Json summary = read_summary(folder);
  if (summary.empty()) return RunState::absent;
  const bool same = text_in(summary, "scene_hash") == fmt::format("{:016x}", scene_hash);
  return same && ended_by_itself(text_in(summary, "outcome")) ? RunState::finished
                                                              : RunState::unfinished;
}

const std::vector<double>& StudyResult::series(const std::string& name) const {
  const auto known = read_.find(name);
  if (known != read_.end()) return known->second;
  std::vector<double> values;
  if (run->scene.afm && is_figure_of_a_run(name)) {
    if (const Json figure = afm_figure(summary, name); !figure.is_null())
      values.push_back(figure.get<double>());
  } else if (elsewhere.empty() && std::filesystem::exists(folder / "run.h5")) {
    const auto file = hdf5::File::open(folder / "run.h5");
    const auto rows = file.contains("/history/time") ? file.shape("/history/time").at(0) : 0;
    const auto history = [&](const std::string& series) {
      std::vector<double> all(rows, std::nan(""));
      if (file.contains("/history/" + series)) all = file.read_doubles("/history/" + series);
      all.resize(rows, std::nan(""));
      return all;
    };
    const std::vector<SeriesInfo> has = study_series(run->scene);
    if (std::ranges::find(has, name, &SeriesInfo::name) != has.end())
      values = study_values(run->scene, name, history);
  }
  return read_.emplace(name, std::move(values)).first->second;
}

void read_result(StudyResult& result) {
  if (!result.elsewhere.empty()) {
    result.failure = result.elsewhere;
    return;
  }
  result.summary = read_summary(result.folder);
  const std::string outcome = text_in(result.summary, "outcome");
  const bool stopped_well = outcome.starts_with("stopped as expected");
  result.usable = outcome == "done" || stopped_well;
  if (result.kept) result.code = result.usable && !any_unmet(result.summary) ? 0 : 3;
  if (!result.failure.empty() || (result.usable && result.code == 0)) return;
  if (!result.usable && !outcome.empty())
    result.failure = outcome;
  else if (any_unmet(result.summary))
    result.failure =
        "expectations of its scene not met: " + expectations_met(result.summary) + " met";
  else
    result.failure = fmt::format("ended with exit code {}", result.code);
}

std::vector<Figure> figures_of(const StudyResult& result) {
  const Json& s = result.summary;
  if (result.run->scene.afm) return afm_figures_in(result);
  std::vector<Figure> figures{{"outcome", "", text_in(s, "outcome")},
                              {"expectations_met", "", expectations_met(s)},
                              {"quality", "", quality_text(result)},
                              {"particles", "", number_in(s, "particles")},
                              {"elements", "", number_in(s, "elements")},
                              {"steps", "", number_in(s, "steps")},
                              {"wall_seconds", "s", number_in(s, "wall_seconds")},
                              {"relative_density", "-", number_in(s, "relative_density")},
                              {"stress_ratio/axial", "-", number_in(s, "stress_ratio/axial")},
                              {"stress_ratio/lateral", "-", number_in(s, "stress_ratio/lateral")}};
  std::ranges::move(peak_values(result), std::back_inserter(figures));
  add_forces(figures, result);
  add_shear(figures, s);
  add_transmission(figures, result);
  figures.push_back({"energy_balance_error", "-", number_in(s, "energy_balance_error")});
  figures.push_back({"kinetic_ratio", "-", number_in(s, "kinetic_ratio")});
  add_fits(figures, result);
  figures.push_back({"scene_hash", "", text_in(s, "scene_hash")});
  figures.push_back({"commit", "", text_in(s, "commit")});
  return figures;
}

std::vector<std::string> varied_keys(const Study& study) {
  std::vector<std::string> keys;
  for (const StudyRun& run : study.runs)
    for (const StudySetting& setting : run.varied)
      if (std::ranges::find(keys, setting.path) == keys.end()) keys.push_back(setting.path);
  return keys;
}

std::string varied_value(const StudyRun& run, const std::string& key) {
  std::string text;  // the last one wins, as in the scene
  for (const StudySetting& setting : run.varied) {
    if (setting.path != key) continue;
    const auto* string = setting.value.as<std::string>();
    text = string != nullptr ? *string : document::value_text(setting.value);
  }
  return text;
}

std::string study_csv(const Study& study, const std::vector<StudyResult>& results) {
  const std::vector<std::string> keys = varied_keys(study);
  std::vector<std::string> columns;  // figures of any run, in order of first occurrence
  std::vector<std::map<std::string, Json>> rows;
  for (const StudyResult& result : results) {
    rows.emplace_back();
    std::size_t at = 0;
    for (const Figure& figure : figures_of(result)) {
      const bool plain = figure.unit.empty();
      const std::string column = plain ? figure.name : figure.name + " [" + figure.unit + "]";
      const auto known = std::ranges::find(columns, column);
      const auto place = known - columns.begin();
      if (known == columns.end())
        columns.insert(columns.begin() + static_cast<std::ptrdiff_t>(at), column);
      at = 1 + static_cast<std::size_t>(known == columns.end() ? static_cast<std::ptrdiff_t>(at)
                                                               : place);
      rows.back()[column] = figure.value;
    }
  }
  std::string text = "run,variation,scene,seed";
  for (const std::string& key : keys) text.append(",").append(csv_word(key));
  for (const std::string& column : columns) text.append(",").append(csv_word(column));
  text += "\n";
  for (std::size_t i = 0; i < results.size(); ++i) {
    const StudyRun& run = *results[i].run;
    text += fmt::format("{},{},{},{}", csv_word(run.name), csv_word(run.variation),
                        csv_word(run.file.filename().string()), run.scene.seed);
    for (const std::string& key : keys) text.append(",").append(csv_word(varied_value(run, key)));
    for (const std::string& column : columns) text.append(",").append(cell_text(rows[i][column]));
    text += "\n";
  }
  return text;
}

}  // namespace pulvis
