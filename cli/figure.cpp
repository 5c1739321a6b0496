#include "cli/figure.hpp"

#include <fmt/format.h>

#include "cli/python_scripts/python_scripts.hpp"
#include "cli/tell.hpp"
#include "engine/files/hdf5.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {
namespace {

// The given options, in the scripts' form: the scripts know which values are allowed.
std::vector<std::string> arguments(const ScriptFolder& scripts, const FigureOptions& options) {
  std::vector<std::string> all{"python3",
                               "-B",
                               (scripts.path / "pulvis/figures/__main__.py").string(),
                               "--format=" + options.format,
                               "--level=" + options.level,
                               "--draw-into=" + scripts.drawn().string()};
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) all.push_back(fmt::format("--{}={}", name, value));
  };
  add("output", options.output.string());
  add("animate", options.animation.string());
  add("field", options.field);
  if (options.frame) all.push_back(fmt::format("--frame={}", *options.frame));
  for (const auto& series : options.series) all.push_back("--series=" + series);
  add("against", options.against);
  add("width", options.width);
  add("height", options.height);
  add("cmap", options.colours);
  add("range", options.range);
  add("dpi", options.dpi);
  add("across", options.across);
  add("at", options.at);
  if (options.no_title) all.push_back("--no-title");
  all.insert(all.end(), {"--", options.folder.string()});  // the folder's name may begin with a '-'
  return all;
}

// Figures are drawn from what there is. A run that goes on changes its history meanwhile.
bool tell_damage(const std::filesystem::path& folder) {
  const std::filesystem::path results = folder / "run.h5";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(results, ignored) || is_locked(folder)) return false;
  const std::vector<std::string> damaged = hdf5::File::open(results).damaged_datasets();
  for (const std::string& dataset : damaged)
    tell(stderr,
         "figure: {}: {}: its bytes are not those that were written: the checksum differs; its "
         "values are lost, and figures that show them are wrong\n",
         results.string(), dataset);
  return !damaged.empty();
}

}  // namespace

ExitCode draw_figures(const FigureOptions& options) {
  const bool is_damaged = tell_damage(options.folder);
  const ScriptFolder scripts("pulvis/");
  const int code = run_python(arguments(scripts, options));
  put_in_place(scripts.drawn());
  switch (code) {
    case 0:
      return is_damaged ? ExitCode::machine : ExitCode::done;
    case 2:
      return ExitCode::usage;
    default:
      return ExitCode::machine;
  }
}

}  // namespace pulvis
