#include "cli/campaigns/study/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

#include "cli/campaigns/study/analysis/study_series.hpp"
#include "cli/campaigns/study/study_curves.hpp"
#include "cli/campaigns/study/study_fit_files.hpp"
#include "cli/campaigns/study/study_quality.hpp"
#include "cli/campaigns/study/study_statistics.hpp"
#include "cli/report/report_encoding.hpp"
#include "cli/report/report_page.hpp"
#include "cli/report/report_thumbnail.hpp"
#include "cli/summary.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t thumbnail_pixels = 3'000'000;  // all together, in bytes before deflation

Json run_json(const Study& study, const StudyResult& result) {
  Json varied = Json::object();
  for (const std::string& key : varied_keys(study)) varied[key] = varied_value(*result.run, key);
  Json json{{"name", result.run->name},
            {"variation", result.run->variation},
            {"scene", result.run->file.filename().string()},
            {"seed", result.run->scene.seed},
            {"varied", varied},
            {"code", result.code},
            {"complete", result.usable}};
  if (!result.failure.empty()) json["failure"] = result.failure;
  json["values"] = Json::array();
  for (const Figure& figure : figures_of(result))
    json["values"].push_back(
        {{"name", figure.name}, {"unit", figure.unit}, {"value", figure.value}});
  json["quality"] = quality_flags(result);
  for (const char* part : {"fits", "transmission"})
    if (result.summary.contains(part)) json[part] = result.summary[part];
  return json;
}

Json verdicts_json(const std::vector<Verdict>& verdicts) {
  Json list = Json::array();
  for (const Verdict& verdict : verdicts) {
    list.push_back({{"what", verdict.what},
                    {"measured", verdict.measured},
                    {"expected", verdict.allowed},
                    {"met", verdict.met}});
    if (verdict.value) list.back()["value"] = *verdict.value;
  }
  return list;
}

Json labels_json(const Study& study) {
  Json labels = Json::object();
  for (const StudyRun& run : study.runs)
    for (const SeriesInfo& series : study_series(run.scene)) labels[series.name] = series.label;
  return labels;
}

std::string title_of(const Study& study) {
  return study.spec.title.empty() ? study.file.stem().string() : study.spec.title;
}

Json study_json(const Study& study, const std::vector<StudyResult>& results,
                const StudyFindings& findings, const StudyTimes& times) {
  Json json{{"title", title_of(study)},   {"version", program_version()},
            {"commit", program_commit()}, {"wall_seconds", times.wall_seconds},
            {"jobs", times.jobs},         {"threads_per_run", times.threads}};
  json["runs"] = Json::array();
  for (const StudyResult& result : results) json["runs"].push_back(run_json(study, result));
  json["expectations"] = verdicts_json(findings.verdicts);
  if (!findings.fits.empty()) json["fits"] = fits_json(findings.fits);
  json["labels"] = labels_json(study);
  return json;
}

Json curves_json(const std::vector<DrawnCurve>& curves) {
  Json list = Json::array();
  for (const DrawnCurve& curve : curves) {
    Json lines = Json::array();
    for (const StudyLine& line : curve.lines) {
      Json one{{"variation", line.variation}, {"runs", line.runs}, {"x", line.x}, {"y", line.y}};
      if (!line.low.empty()) {
        one["low"] = line.low;
        one["high"] = line.high;
        one["standard_deviation"] = line.deviation;
      }
      lines.push_back(one);
    }
    list.push_back({{"title", curve.title},
                    {"x", curve.x},
                    {"y", curve.y},
                    {"x_unit", curve.x_unit},
                    {"y_unit", curve.y_unit},
                    {"lines", lines}});
  }
  return list;
}

// The last frame of every run, as far as space allows; each field has a common colour scale.
Json with_thumbnails(Json head, const std::vector<StudyResult>& results) {
  const int side = thumbnail_side(results.size(), thumbnail_pixels);
  if (side == 0) return head;
  std::map<std::string, Json> scales;
  std::vector<std::optional<Thumbnail>> all;
  for (const StudyResult& result : results) {
    all.push_back(result.elsewhere.empty() ? thumbnail_of(result.folder / "run.h5", side)
                                           : std::nullopt);
    const std::optional<Thumbnail>& one = all.back();
    if (!one || one->field.empty()) continue;
    Json& scale = scales
                      .try_emplace(one->field, Json{{"field", one->field},
                                                    {"unit", one->unit},
                                                    {"low", one->range.low},
                                                    {"high", one->range.high}})
                      .first->second;
    scale["low"] = std::min(scale["low"].get<double>(), one->range.low);
    scale["high"] = std::max(scale["high"].get<double>(), one->range.high);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i]) continue;
    const auto scale = scales.find(all[i]->field);
    const Range colours = scale == scales.end() ? Range{}
                                                : Range{scale->second["low"].get<double>(),
                                                        scale->second["high"].get<double>()};
    head["runs"][i]["thumbnail"] = thumbnail_png(*all[i], colours);
  }
  head["thumbnails"] = Json::array();
  for (const auto& [field, scale] : scales) head["thumbnails"].push_back(scale);
  return head;
}

// In the page the numbers of all lines form one packed list; each line stores its count.
ReportData page_data(const Study& study, Json head, const std::vector<DrawnCurve>& curves) {
  std::vector<float> numbers;
  const auto put = [&](const std::vector<double>& values) {
    for (const double value : values) numbers.push_back(static_cast<float>(value));
  };
  head["curves"] = Json::array();
  for (const DrawnCurve& curve : curves) {
    Json lines = Json::array();
    for (const StudyLine& line : curve.lines) {
      const bool band = !line.low.empty();
      lines.push_back({{"variation", line.variation},
                       {"runs", line.runs},
                       {"first", numbers.size()},
                       {"count", line.x.size()},
                       {"band", band}});
      for (const auto* values : {&line.x, &line.y, &line.low, &line.high, &line.deviation})
        put(*values);
    }
    head["curves"].push_back({{"title", curve.title},
                              {"x", curve.x},
                              {"y", curve.y},
                              {"x_unit", curve.x_unit},
                              {"y_unit", curve.y_unit},
                              {"lines", lines}});
  }
  return {title_of(study),
          head.dump(-1, ' ', false, Json::error_handler_t::replace),
          {{"numbers", encoded(numbers)}}};
}

// Files without a fitted law are left over from the study before it was changed.
void write_fits(const std::filesystem::path& folder, const std::vector<FittedLaw>& fits) {
  const auto write = [&](const char* name, bool any, const auto& text) {
    any ? write_own(folder / name, role::study, text(fits))
        : remove_own(folder / name, role::study);
  };
  const auto powers = static_cast<std::size_t>(std::ranges::count_if(fits, is_power));
  write("fits.csv", !fits.empty(), fits_csv);
  write("strengths.csv", powers < fits.size(), strengths_csv);
  write("sensitivities.csv", powers > 0, sensitivities_csv);
}

}  // namespace

void write_study(const std::filesystem::path& folder, const Study& study,
                 const std::vector<StudyResult>& results, const StudyFindings& findings,
                 const StudyTimes& times) {
  Json summary = study_json(study, results, findings, times);
  const StudyStatistics statistics = statistics_of(study, results);
  summary["variations"] = variations_json(statistics);
  summary["effects"] = effects_json(statistics);
  const std::vector<DrawnCurve> curves = study_curves(study, results);
  write_own(folder / "study.csv", role::study, study_csv(study, results));
  write_own(folder / "summary.json", role::study, summary.dump(2) + "\n");
  write_own(folder / "variations.csv", role::study, variations_csv(study, statistics));
  statistics.effects.empty()
      ? remove_own(folder / "effects.csv", role::study)
      : write_own(folder / "effects.csv", role::study, effects_csv(statistics));
  write_own(folder / "curves.json", role::study, curves_json(curves).dump() + "\n");
  write_fits(folder, findings.fits);
  write_page(folder / "report.html", "study.html",
             {"units.js", "names.js", "payload.js", "save.js", "chart.js", "maps.js", "settings.js",
              "fits.js", "tables.js", "study_tables.js", "study_effects.js", "study.js"},
             page_data(study, with_thumbnails(summary, results), curves), role::study);
}

}  // namespace pulvis
