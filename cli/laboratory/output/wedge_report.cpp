// report.html of a wedge calibration: its loops, and their results. cli/report/page/wedge.js draws them.
#include "cli/laboratory/output/wedge_report.hpp"

#include <nlohmann/json.hpp>

#include "cli/report/report_page.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

Json wedge_loop_json(const wedge::Loop& loop) {
  Json json{{"slope", loop.slope},
            {"load", loop.load},
            {"half_width", loop.half_width},
            {"offset", loop.offset}};
  if (loop.half_width_error) json["half_width_error"] = *loop.half_width_error;
  if (loop.offset_error) json["offset_error"] = *loop.offset_error;
  return json;
}

}  // namespace

void write_wedge_report(const std::filesystem::path& folder, const WedgeReduction& reduction) {
  const std::string& named = reduction.loaded.settings.title;
  const std::string title = named.empty() ? "Wedge calibration" : named;
  Json head{{"summary", wedge_json(reduction)},
            {"loops", Json::array()},
            {"file", reduction.file.filename().string()},
            {"settings", reduction.loaded.text}};
  for (const wedge::Loop& loop : reduction.loops) head["loops"].push_back(wedge_loop_json(loop));
  write_page(folder / "report.html", "wedge.html",
             {"units.js", "payload.js", "save.js", "chart.js", "tables.js", "wedge.js"},
             {title, head.dump(-1, ' ', false, Json::error_handler_t::replace), {}},
             role::reduction);
}

}  // namespace pulvis
