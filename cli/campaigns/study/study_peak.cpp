#include "cli/campaigns/study/study_peak.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/results/results.hpp"
#include "scenes/tools/die_cell.hpp"

namespace pulvis {
namespace {

// The sample with the highest relative density; none if all are NaN.
std::optional<std::size_t> densest(const std::vector<double>& density) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < density.size(); ++i)
    if (std::isfinite(density[i]) && (!best || density[i] > density[*best])) best = i;
  return best;
}

}  // namespace

std::vector<Figure> peak_values(const StudyResult& result) {
  const Scene& scene = result.run->scene;
  if (scene.afm) return {};
  const std::optional<DieCell> cell = die_cell(scene);
  if (!cell) return {};
  const auto name = [&](int tool) { return scene.tools[static_cast<std::size_t>(tool)].name; };
  const auto at = densest(result.series("relative_density"));
  std::vector<Figure> values;
  const auto add = [&](const char* column, const char* unit, const std::string& series,
                       double sign = 1) {
    const std::vector<double>& all = result.series(series);
    const bool has = at && *at < all.size() && std::isfinite(all[*at]);
    values.push_back({std::string("peak/") + column, unit,
                      has ? nlohmann::ordered_json(sign < 0 ? 0 - all[*at] : all[*at])
                          : nlohmann::ordered_json()});
  };
  add("relative_density", "-", "relative_density");
  add("top_force", "N", "tool/" + name(cell->top) + "/force_y");
  add("bottom_force", "N", "tool/" + name(cell->bottom) + "/force_y", -1);
  add("top_pressure", "Pa", "pressure/" + name(cell->top));
  add("transmission", "-", "transmission");
  add("stress_ratio/axial", "-", "stress_ratio/axial");
  add("stress_ratio/lateral", "-", "stress_ratio/lateral");
  return values;
}

}  // namespace pulvis
