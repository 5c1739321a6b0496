#include "cli/campaigns/probe/probe_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/campaigns/probe/probe_scenes.hpp"
#include "engine/files/hdf5.hpp"
#include "scenes/results/run_quality.hpp"

namespace pulvis {
namespace {

struct StageTimes {
  double begin = 0, end = 0;  // s
};
// None: the stage has not ended.
std::optional<StageTimes> times_of_stage(const StudyResult& result, const std::string& name) {
  if (!result.summary.contains("stages")) return std::nullopt;
  double begin = 0;
  for (const auto& stage : result.summary.at("stages")) {
    const double end = stage.at("end").get<double>();
    if (stage.at("name") == name) return StageTimes{begin, end};
    begin = end;
  }
  return std::nullopt;
}

double at_time(const std::vector<double>& times, const std::vector<double>& values, double time) {
  const auto after = std::ranges::lower_bound(times, time) - times.begin();
  if (after <= 0) return values.front();
  if (after >= std::ssize(times)) return values.back();
  const auto i = static_cast<std::size_t>(after);
  const double way = times[i] - times[i - 1];
  const double share = way > 0 ? (time - times[i - 1]) / way : 1;
  return (1 - share) * values[i - 1] + share * values[i];
}

// J, dissipated so far.
std::vector<double> dissipation_of(const StudyResult& result) {
  std::vector<double> sum = result.series("energy/plastic");
  for (const char* name : {"energy/indentation", "energy/friction", "energy/damping",
                           "energy/bulk_damping", "energy/fracture"}) {
    const std::vector<double>& one = result.series(name);
    for (std::size_t i = 0; i < std::min(sum.size(), one.size()); ++i) sum[i] += one[i];
  }
  return sum;
}

// From the samples after the release.
ProbeCurve curve_of(const StudyResult& result, const ProbeSpec& spec) {
  ProbeCurve curve;
  const std::vector<double>& times = result.series("time");
  const auto begin = std::ranges::lower_bound(times, (1 - 1e-9) * spec.duration) - times.begin();
  const auto at = static_cast<std::size_t>(begin);
  const std::vector<double> spent = dissipation_of(result);
  const std::vector<double>& width = result.series("cell/width");
  const std::vector<double>& height = result.series("cell/height");
  const double thickness = result.run->scene.thickness;
  for (std::size_t i = at; i < times.size(); ++i) {
    const auto value = [&](const char* name, std::size_t sample) {
      return result.series(name)[sample];
    };
    const auto strain = [&](const char* name) { return value(name, i) - value(name, at); };
    curve.strain.push_back(
        {strain("cell/strain_xx"), strain("cell/strain_yy"), strain("cell/strain_xy")});
    curve.stress.push_back({value("cell/stress_xx", i), value("cell/stress_yy", i),
                            value("cell/stress_xy", i), value("stress/zz", i)});
    curve.dissipated.push_back((spent[i] - spent[at]) / (width[at] * height[at] * thickness));
  }
  return curve;
}

}  // namespace

std::string name_of_run(const ProbeState& state, std::optional<double> angle) {
  const std::string name = fmt::format("{},density={}", state.loading, density_name(state.asked));
  if (!angle) return name + ",shear";
  constexpr double half = 0.5 + 1e-6;  // ties are rounded up, whatever the round-off of the angle
  const double tenths = std::floor(1800 / std::numbers::pi * *angle + half);
  return fmt::format("{},direction={:g}", name, tenths / 10);
}

std::vector<ProbeState> states_of(const ProbeLoading& loading, const ProbeSpec& spec,
                                  const StudyResult& result, std::vector<std::string>& passed) {
  std::vector<ProbeState> states;
  for (const double density : spec.densities) {
    const std::string name = density_name(density);
    const auto stage = times_of_stage(result, name);
    if (!stage || !std::filesystem::exists(result.folder / ("state-" + name + ".h5"))) continue;
    ProbeState state{loading.path, loading.seed, density, loading.name};
    const auto value_at = [&](double time, const char* series) {
      return at_time(result.series("time"), result.series(series), time);
    };
    if (const double before = value_at(stage->begin, "relative_density"); before >= density) {
      passed.push_back(fmt::format(
          "{}: the powder already has a relative density of {:.4f} before it is pressed to {:g}",
          loading.name, before, density));
      continue;
    }
    const auto value = [&](const char* series) { return value_at(stage->end, series); };
    state.density = value("relative_density");
    state.stress = {value("cell/stress_xx"), value("cell/stress_yy"), value("cell/stress_xy"),
                    value("stress/zz")};
    state.pressure = -(state.stress[0] + state.stress[1] + state.stress[3]) / 3;
    state.bonded = !loading.scene.scene.bonds.empty();
    states.push_back(std::move(state));
  }
  return states;
}

// By the quality tables of the runs.
std::optional<double> spring_share_of(const std::vector<ProbeRun>& runs) {
  double sum = 0, count = 0;
  for (const ProbeRun& run : runs) {
    if (!run.result->usable || !run.result->summary.contains("quality")) continue;
    for (const auto& figure : run.result->summary.at("quality"))
      if (figure.at("name") == release_figure) {
        sum += figure.at("value").get<double>();
        count += 1;
      }
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

ProbeSurface surface_of(const ProbeState& state, const ProbeSpec& spec,
                        const std::vector<ProbeRun>& runs) {
  ProbeSurface surface;
  surface.state = &state;
  surface.spring_share = spring_share_of(runs);
  std::vector<ProbeCurve> curves;
  std::optional<ProbeCurve> shear;
  for (const ProbeRun& run : runs) {
    if (!run.result->usable) continue;
    ProbeCurve curve = curve_of(*run.result, spec);
    if (curve.strain.size() < 2) continue;
    if (run.angle) {
      curve.angle = *run.angle;
      curves.push_back(std::move(curve));
    } else {
      shear = std::move(curve);
    }
  }
  if (curves.empty()) return surface;
  surface.moduli = moduli_of(curves, shear ? &*shear : nullptr, spec.elastic_strain);
  for (const ProbeCurve& curve : curves) {
    if (const auto point = offset_yield(curve, surface.moduli, spec.offset_strain))
      surface.offset.push_back(*point);
    if (const auto point =
            dissipation_yield(curve, surface.moduli, spec.dissipation * state.pressure))
      surface.dissipation.push_back(*point);
  }
  const std::array<double, 2> centre{spec.release * state.stress[0],
                                     spec.release * state.stress[1]};
  find_normality(surface.offset, centre, spec.directions);
  find_normality(surface.dissipation, centre, spec.directions);
  surface.offset_models = fit_caps(surface.offset, state.density, state.bonded);
  surface.dissipation_models = fit_caps(surface.dissipation, state.density, state.bonded);
  return surface;
}

}  // namespace pulvis
