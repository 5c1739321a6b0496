#include "cli/report/report.hpp"

#include <string>
#include <system_error>
#include <utility>

#include "cli/report/report_assets.hpp"
#include "cli/report/report_data.hpp"
#include "cli/report/report_page.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

// Scripts of all pages; then the panels, each a separate file that registers itself (panels.js), and those of the page
// itself. The library is only for particles in three dimensions.
std::vector<std::string> scripts(const std::vector<std::string>& page, bool in_space) {
  std::vector<std::string> names{
      "units.js",       "names.js",     "payload.js",       "save.js",          "chart.js",
      "maps.js",        "raster.js",    "run.js",           "tags.js",          "field.js",
      "field_tools.js", "field_tip.js", "space_section.js", "space_picture.js", "space_view.js",
      "space_tip.js",   "solid.js",     "timeline.js",      "settings.js",      "panels.js",
      "fits.js",        "words.js",     "tables.js"};
  if (in_space) names.insert(names.begin(), "twgl.js");
  for (const auto& panel : report_assets_named("panel_")) names.push_back(panel);
  names.insert(names.end(), page.begin(), page.end());
  return names;
}

void write_report_as(const std::filesystem::path& run_folder, const std::filesystem::path& page,
                     const char* role) {
  require_own_or_none(page, role);
  const ReportData data = read_report_data(run_folder);
  write_page(page, "page.html", scripts({"stage.js", "report.js"}, data.in_space), data, role);
}

}  // namespace

void require_run(const std::filesystem::path& folder, const std::string& command) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::exists(folder / "run.h5", error)) return;
  const std::string name = command + ": " + folder.string();
  if (!fs::is_directory(folder, error)) throw NotARun(name + ": no such folder");
  for (const auto& [file, kind] : {std::pair{"study.toml", "study"},
                                   {"probe.toml", "probe"},
                                   {"fit.toml", "fit"},
                                   {"reduce.toml", "reduction"}})
    if (fs::exists(folder / file, error))
      throw NotARun(
          name + " is the folder of a " + kind + "; " + command + " is for folders of runs" +
          (fs::exists(folder / "report.html", error) ? ", and this one has its report.html" : ""));
  throw NotARun(name + " holds no run: there is no run.h5");
}

void write_report(const std::filesystem::path& run_folder) {
  write_report_as(run_folder, run_folder / "report.html", role::run);
}

void write_report(const std::filesystem::path& run_folder, const std::filesystem::path& page) {
  write_report_as(run_folder, page, role::comparison);
}

void write_comparison(const std::vector<std::filesystem::path>& run_folders,
                      const std::filesystem::path& page) {
  require_own_or_none(page, role::comparison);
  const ReportData data = read_comparison(run_folders);
  write_page(page, "compare.html", scripts({"compare.js"}, data.in_space), data, role::comparison);
}

std::string live_page() {
  return page_text("page.html", scripts({"stage.js", "live.js"}, true),
                   {"Pulvis: a run under way", {}, {}, true}, Loads::from_its_server);
}

}  // namespace pulvis
