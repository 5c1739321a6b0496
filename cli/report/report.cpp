#include "cli/report/report.hpp"

#include "cli/report/report_assets.hpp"
#include "cli/report/report_data.hpp"
#include "cli/report/report_page.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

// Scripts of both pages; last the panels, each a separate file that registers itself (panels.js). The library is
// only for particles in three dimensions.
std::vector<std::string> scripts(const char* page, bool in_space) {
  std::vector<std::string> names{
      "units.js",       "names.js",     "payload.js",       "save.js",          "chart.js",
      "maps.js",        "raster.js",    "run.js",           "tags.js",          "field.js",
      "field_tools.js", "field_tip.js", "space_section.js", "space_picture.js", "space_view.js",
      "space_tip.js",   "solid.js",     "timeline.js",      "settings.js",      "panels.js",
      "fits.js",        "words.js",     "tables.js"};
  if (in_space) names.insert(names.begin(), "twgl.js");
  for (const auto& panel : report_assets_named("panel_")) names.push_back(panel);
  names.emplace_back(page);
  return names;
}

}  // namespace

void write_report(const std::filesystem::path& run_folder) {
  require_own_or_none(run_folder / "report.html", role::run);
  const ReportData data = read_report_data(run_folder);
  write_page(run_folder / "report.html", "page.html", scripts("report.js", data.in_space), data,
             role::run);
}

void write_comparison(const std::vector<std::filesystem::path>& run_folders,
                      const std::filesystem::path& page) {
  require_own_or_none(page, role::comparison);
  const ReportData data = read_comparison(run_folders);
  write_page(page, "compare.html", scripts("compare.js", data.in_space), data, role::comparison);
}

}  // namespace pulvis
