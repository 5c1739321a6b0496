#include "cli/campaigns/study/analysis/study_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scenes/checks/expect_checks.hpp"
#include "scenes/results/results.hpp"
#include "scenes/spec/dimension_words.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/tools/die_cell.hpp"

namespace pulvis {
namespace {

constexpr double min_force_share = 0.05;

struct Face {  // of a tool of the die
  std::string along;
  double sign;        // of a force towards the tool
  int first, second;  // tools whose distance is the length of the face
  std::string across;
};

std::optional<Face> face_of(const DieCell& cell, int tool) {
  if (tool == cell.top) return Face{"y", 1, cell.left, cell.right, "x"};
  if (tool == cell.bottom) return Face{"y", -1, cell.left, cell.right, "x"};
  if (tool == cell.right) return Face{"x", 1, cell.bottom, cell.top, "y"};
  if (tool == cell.left) return Face{"x", -1, cell.bottom, cell.top, "y"};
  return std::nullopt;
}

std::vector<std::string> tool_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const ToolSpec& tool : scene.tools) names.push_back(tool.name);
  return names;
}

std::string tool_series(const Scene& scene, int tool, const std::string& what) {
  return "tool/" + scene.tools[static_cast<std::size_t>(tool)].name + "/" + what;
}

int tool_called(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.tools, name, &ToolSpec::name);
  return static_cast<int>(found - scene.tools.begin());
}

std::vector<double> travel(const Scene& scene, const std::string& tool, const History& history) {
  std::vector<double> distance;
  for (const char axis : std::string_view(words_of(scene).axes)) {
    const std::vector<double> at = history("tool/" + tool + "/position_" + axis);
    distance.resize(at.size());
    for (std::size_t i = 0; i < at.size(); ++i)
      distance[i] = std::hypot(distance[i], at[i] - at.front());
  }
  return distance;
}

std::vector<double> pressure(const Scene& scene, int tool, const History& history) {
  const Face face = *face_of(*die_cell(scene), tool);
  std::vector<double> values = history(tool_series(scene, tool, "force_" + face.along));
  const auto low = history(tool_series(scene, face.first, "position_" + face.across));
  const auto high = history(tool_series(scene, face.second, "position_" + face.across));
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] *= face.sign / ((high[i] - low[i]) * scene.thickness);
  return values;
}

// The ratio of the forces on two punches says nothing while they hardly touch the powder.
std::vector<double> above_light_loads(std::vector<double> values, const std::vector<double>& load) {
  const double maximum = load.empty() ? 0 : std::ranges::max(load);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(load[i] > min_force_share * maximum))
      values[i] = std::numeric_limits<double>::quiet_NaN();
  return values;
}

std::vector<double> share_below(const Scene& scene, const History& history) {
  const DieCell cell = *die_cell(scene);
  std::vector<double> values = history(tool_series(scene, cell.bottom, "force_y"));
  const std::vector<double> top = history(tool_series(scene, cell.top, "force_y"));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] /= -top[i];
  return above_light_loads(std::move(values), top);
}

}  // namespace

std::vector<SeriesInfo> study_series(const Scene& scene) {
  if (scene.afm) {
    std::vector<SeriesInfo> all{{study_abscissa(scene, false), "-", "actions completed",
                                 "of the programme that are completed, including partial ones"}};
    for (const SeriesInfo& series : expectable_series(scene)) all.push_back(series);
    return all;
  }
  std::vector<SeriesInfo> all{{"time", "s", "time $t$", "of the sample"}};
  for (const SeriesInfo& series : history_series(scene)) all.push_back(series);
  for (const std::string& tool : tool_names(scene))
    all.push_back({"travel/" + tool, "m", "travel of " + tool + " $s$",
                   "displacement since the first sample"});
  const std::optional<DieCell> cell = die_cell(scene);
  if (!cell) return all;
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    if (face_of(*cell, static_cast<int>(t)))
      all.push_back({"pressure/" + scene.tools[t].name, "Pa",
                     "pressure on " + scene.tools[t].name + " $p$",
                     "force towards the tool / area of its face"});
  all.push_back(
      {"transmission", "-", "transmission", "force on the bottom punch / force on the top punch"});
  return all;
}

std::string study_abscissa(const Scene& scene, bool placed) {
  return scene.afm ? "actions" : placed ? "relative_density" : "time";
}

std::vector<double> study_values(const Scene& scene, const std::string& name,
                                 const History& history) {
  if (scene.afm) return history(name == study_abscissa(scene, false) ? "time" : name);
  const auto after = [&](const char* prefix) {
    return name.starts_with(prefix) ? name.substr(std::string(prefix).size()) : std::string();
  };
  if (const std::string tool = after("travel/"); !tool.empty()) return travel(scene, tool, history);
  if (const std::string tool = after("pressure/"); !tool.empty())
    return pressure(scene, tool_called(scene, tool), history);
  if (name == "transmission") return share_below(scene, history);
  if (name == "stress/transmission")
    return above_light_loads(history(name), history("stress/axial_top"));
  return history(name);
}

}  // namespace pulvis
