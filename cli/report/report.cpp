#include "cli/report/report.hpp"

#include "cli/report/report_assets.hpp"
#include "cli/report/report_data.hpp"
#include "cli/report/report_page.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

// What both pages are made of; last the panels, each a file of its own that enters itself (panels.js).
std::vector<std::string> scripts(const char* page) {
  std::vector<std::string> names{"units.js", "names.js",    "payload.js",     "save.js",
                                 "chart.js", "maps.js",     "raster.js",      "run.js",
                                 "tags.js",  "field.js",    "field_tools.js", "field_tip.js",
                                 "solid.js", "timeline.js", "settings.js",    "panels.js",
                                 "fits.js",  "words.js",    "tables.js"};
  for (const auto& panel : report_assets_named("panel_")) names.push_back(panel);
  names.emplace_back(page);
  return names;
}

}  // namespace

void write_report(const std::filesystem::path& run_folder) {
  require_own_or_none(run_folder / "report.html", role::run);
  write_page(run_folder / "report.html", "page.html", scripts("report.js"),
             read_report_data(run_folder), role::run);
}

void write_comparison(const std::vector<std::filesystem::path>& run_folders,
                      const std::filesystem::path& page) {
  require_own_or_none(page, role::comparison);
  write_page(page, "compare.html", scripts("compare.js"), read_comparison(run_folders),
             role::comparison);
}

}  // namespace pulvis
