// cli/report/afm.js draws what is put together here.
#include "cli/report_afm.hpp"

#include <nlohmann/json.hpp>

#include "cli/report_encoding.hpp"
#include "cli/report_page.hpp"
#include "scenes/afm_programme.hpp"
#include "scenes/afm_scene.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

Json actions_json(const AfmScene& afm) {
  static constexpr const char* kinds[] = {"press", "scan", "retract", "hold"};
  Json actions = Json::array();
  for (const ActionSpec& action : afm.actions) {
    const bool lateral = action.direction == TargetSpec::Direction::lateral;
    actions.push_back({{"kind", kinds[static_cast<int>(action.kind)]},
                       {"axis", lateral ? "y" : "x"},
                       {"back", action.back}});
  }
  return actions;
}

}  // namespace

void write_afm_report(const std::filesystem::path& folder, const LoadedScene& loaded,
                      const AfmReport& report, const AfmHistory& history) {
  const std::string title = loaded.scene.title.empty() ? "AFM" : loaded.scene.title;
  Json head{{"title", title},
            {"summary", Json::parse(afm_summary(loaded, report))},
            {"actions", actions_json(*loaded.scene.afm)},
            {"samples", history.rows.size()}};
  std::vector<float> numbers;
  head["series"].push_back({{"name", "time"}, {"unit", "-"}, {"meaning", "actions done"}});
  for (const double time : history.times) numbers.push_back(static_cast<float>(time));
  const auto series = afm_series();
  for (std::size_t k = 0; k < series.size(); ++k) {
    head["series"].push_back(
        {{"name", series[k].name}, {"unit", series[k].unit}, {"meaning", series[k].meaning}});
    for (const auto& row : history.rows) numbers.push_back(static_cast<float>(row[k]));
  }
  write_page(folder / "report.html", "afm.html",
             {"uPlot.iife.min.js", "units.js", "payload.js", "charts.js", "afm.js"},
             {title,
              head.dump(-1, ' ', false, Json::error_handler_t::replace),
              {{"history", encoded(numbers)}}});
}

}  // namespace pulvis
