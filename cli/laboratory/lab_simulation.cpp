#include "cli/laboratory/lab_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pulvis::lab {
namespace {

std::vector<std::string> tools_in(const csv::Table& history) {
  std::vector<std::string> tools;
  for (const csv::Column& column : history.columns) {
    static const std::string before = "tool/", after = "/force_x";
    if (column.name.starts_with(before) && column.name.ends_with(after))
      tools.push_back(
          column.name.substr(before.size(), column.name.size() - before.size() - after.size()));
  }
  return tools;
}

// Friction moves the compact along with the target: both signs depend on the layout of the scene.
void make_positive(std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  if (sum < 0)
    for (double& value : values) value = -value;
}

}  // namespace

std::string name_of_run(const std::filesystem::path& run_folder) {
  const auto path = std::filesystem::absolute(run_folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

csv::Table history_of_run(const std::filesystem::path& run_folder) {
  csv::Table history = csv::read(run_folder / "history.csv");
  for (const csv::Column& column : history.columns)
    if (column.name.starts_with("tool/") && column.name.ends_with("/force_z"))
      csv::refuse(history, column.name,
                  "the run is three-dimensional, allowed: two-dimensional runs");
  return history;
}

SimulatedCurve read_simulation(const std::filesystem::path& run_folder, const std::string& target) {
  const csv::Table history = history_of_run(run_folder);
  const std::string tool = "tool/" + target + "/";
  if (!csv::has_column(history, tool + "force_x"))
    csv::refuse(history, "simulation.target",
                fmt::format("the run has no tool '{}'{}, allowed: {}", target,
                            suggestion(target, tools_in(history)), listed(tools_in(history))));
  const auto series = [&](const char* name, const char* unit) {
    return csv::numbers(history, csv::column_at(history, tool + name), unit);
  };
  const std::vector<double> x = series("position_x", "m");
  const std::vector<double> lateral = series("force_x", "N"), normal = series("force_y", "N");
  SimulatedCurve curve;
  curve.name = name_of_run(run_folder);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] == x.front() || normal[i] == 0) continue;
    curve.distance.push_back(std::abs(x[i] - x.front()));
    curve.friction.push_back(lateral[i] / normal[i]);
  }
  if (curve.distance.size() < 2)
    csv::refuse(
        history, tool + "position_x",
        "the target does not slide along x under a normal force, allowed: a run with a shear "
        "stage");
  make_positive(curve.friction);
  return curve;
}

}  // namespace pulvis::lab
