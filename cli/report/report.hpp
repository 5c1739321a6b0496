// report.html: a single file that shows a run in any browser. Curves,
// energies, quality figures and an animation of the fields, without any other file.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace pulvis {

// Reads run.h5 (complete frames only) and, if there is one, summary.json of the run's folder,
// and writes report.html into it. Every key of the summary is optional; these have a special
// meaning, others are listed as they are:
//   title, outcome, steps, elements, particles, wall_seconds, threads, element_updates_per_second,
//   peak_memory_bytes, thickness, time, relative_density, version, commit, energy_balance_error,
//   kinetic_ratio, materials [{name, density, ...}, SI],
//   tools      [{name, point: [x, y], normal: [x, y]}] or [{name, points: [[x, y], ...]}], which lies to
//              the right of its points, at the end of the run, m; one without a position is not drawn
//   limits     {energy_balance, kinetic_energy, penetration}, dimensionless
//   quality    [{name, value, limit, meaning}]: shown instead of the figures computed from the history
// Throws OutputError if the folder holds no readable run or the report cannot be written.
void write_report(const std::filesystem::path& run_folder);
// The same page elsewhere.
void write_report(const std::filesystem::path& run_folder, const std::filesystem::path& page);

// Several runs on one page: their curves overlaid, their figures in a table, their fields side by
// side with a common scale and colour range.
void write_comparison(const std::vector<std::filesystem::path>& run_folders,
                      const std::filesystem::path& page);

// A folder given as that of a run is none.
class NotARun : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
// Throws NotARun, which says what the folder is instead: that of a study, a fit, a probe or a reduction.
void require_run(const std::filesystem::path& folder, const std::string& command = "report");

// The same page without data: it asks for them where it came from, again and again (page/live.js).
std::string live_page();

}  // namespace pulvis
