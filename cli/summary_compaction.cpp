#include "cli/summary_compaction.hpp"

#include <algorithm>

#include "scenes/results/density_fits.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_points = 100;  // of a drawn curve

Json law_json(const DensityFit& fit) {
  if (!fit.not_fitted.empty()) return {{"law", fit.law}, {"not_fitted", fit.not_fitted}};
  Json parameters = Json::array();
  for (const FitParameter& p : fit.parameters)
    parameters.push_back({{"name", p.name}, {"value", p.value}, {"unit", p.unit}});
  return {
      {"law", fit.law},           {"parameters", parameters},   {"rms", fit.rms},
      {"rms_unit", fit.rms_unit}, {"r_squared", fit.r_squared}, {"rms_density", fit.rms_density}};
}

Json thinned(const std::vector<double>& values) {
  Json kept = Json::array();
  const std::size_t count = std::min(values.size(), max_points);
  for (std::size_t i = 0; i < count; ++i)
    kept.push_back(values[count == 1 ? 0 : i * (values.size() - 1) / (count - 1)]);
  return kept;
}

Json fits_json(const CompactionCurve& curve) {
  const FitRange range = fit_range(curve.densities(), curve.punch_pressures());
  const std::vector<DensityFit> fits = fit_all(range);
  Json json{{"of", "pressure of punch '" + curve.top() + "' against relative density"},
            {"samples", range.density.size()}};
  Json drawn{{"pressure", thinned(range.pressure)}, {"relative_density", thinned(range.density)}};
  if (!range.density.empty()) {
    const auto [low, high] = std::ranges::minmax(range.pressure);
    json["pressure"] = {low, high};
    json["relative_density"] = {range.density.front(), range.density.back()};
  }
  json["laws"] = Json::array();
  for (const DensityFit& fit : fits) {
    json["laws"].push_back(law_json(fit));
    if (fit.not_fitted.empty()) drawn[fit.law] = thinned(fit.densities);
  }
  json["curve"] = drawn;
  return json;
}

Json share_json(const TransmissionShare& share) {
  Json json{{"relative_density", share.density},
            {"height_over_width", share.height_over_width},
            {"lateral_ratio", share.lateral_ratio},
            {"measured", share.measured}};
  if (share.round_die) json["round_die"] = *share.round_die;
  if (share.slot) json["slot"] = *share.slot;
  if (share.slot_measured_ratio) json["slot_measured_ratio"] = *share.slot_measured_ratio;
  return json;
}

Json transmission_json(const Transmission& found) {
  if (!found.not_measured.empty()) return {{"not_measured", found.not_measured}};
  Json json{{"wall_friction", found.wall_friction}, {"poissons_ratio", found.poissons_ratio}};
  if (!found.not_compared.empty()) json["not_compared"] = found.not_compared;
  json["shares"] = Json::array();
  for (const TransmissionShare& share : found.shares) json["shares"].push_back(share_json(share));
  return json;
}

}  // namespace

void add_compaction(Json& summary, const Scene& scene, const CompactionCurve& curve) {
  if (!curve.has_die()) return;
  summary["fits"] = fits_json(curve);
  summary["transmission"] = transmission_json(transmission(scene, curve));
}

}  // namespace pulvis
