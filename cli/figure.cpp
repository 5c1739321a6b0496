#include "cli/figure.hpp"

#include <fmt/format.h>

#include "cli/python_scripts/python_scripts.hpp"

namespace pulvis {
namespace {

std::vector<std::string> arguments(const ScriptFolder& scripts, const FigureOptions& options) {
  std::vector<std::string> all{"python3",
                               "-B",
                               (scripts.path / "figures.py").string(),
                               "--format=" + options.format,
                               "--level=" + options.level,
                               "--draw-into=" + scripts.drawn().string()};
  if (!options.output.empty()) all.push_back("--output=" + options.output.string());
  if (!options.field.empty()) all.push_back("--field=" + options.field);
  if (options.frame) all.push_back(fmt::format("--frame={}", *options.frame));
  for (const auto& series : options.series) all.push_back("--series=" + series);
  if (!options.against.empty()) all.push_back("--against=" + options.against);
  all.insert(all.end(), {"--", options.folder.string()});  // its name may begin with a '-'
  return all;
}

}  // namespace

ExitCode draw_figures(const FigureOptions& options) {
  const ScriptFolder scripts("figure");
  const int code = run_python(arguments(scripts, options));
  put_in_place(scripts.drawn());
  switch (code) {
    case 0:
      return ExitCode::done;
    case 2:
      return ExitCode::usage;
    default:
      return ExitCode::machine;
  }
}

}  // namespace pulvis
