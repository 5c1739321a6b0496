#include "cli/report.hpp"

#include "cli/report_data.hpp"
#include "cli/report_page.hpp"

namespace pulvis {

void write_report(const std::filesystem::path& run_folder) {
  write_page(run_folder / "report.html", "page.html",
             {"uPlot.iife.min.js", "units.js", "payload.js", "summary.js", "charts.js",
              "compaction.js", "shear.js", "picture.js", "observed.js", "report.js"},
             read_report_data(run_folder));
}

}  // namespace pulvis
