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

Mandel stress_at(const StudyResult& result, std::size_t sample) {
  TensorParts parts{};
  for (std::size_t k = 0; k < tensor_parts; ++k) {
    const std::vector<double>& one =
        result.series(fmt::format("cell/stress_{}", tensor_part_names[k]));
    if (sample < one.size()) parts[k] = one[sample];
  }
  if (!result.run->scene.in_space()) parts[2] = result.series("stress/zz").at(sample);
  return mandel_of(parts);
}

Mandel strain_at(const StudyResult& result, std::size_t sample) {
  TensorParts parts{};
  for (std::size_t k = 0; k < tensor_parts; ++k) {
    const std::vector<double>& one =
        result.series(fmt::format("cell/strain_{}", tensor_part_names[k]));
    if (sample < one.size()) parts[k] = one[sample] - one.front();
  }
  return mandel_of(parts);
}

// m^3, at the start of the run.
double volume_of(const StudyResult& result) {
  const Scene& scene = result.run->scene;
  const auto side = [&](const char* name) { return result.series(name).front(); };
  const double area = side("cell/width") * side("cell/height");
  return area * (scene.in_space() ? side("cell/depth") : scene.thickness);
}

ProbeCurve curve_of(const StudyResult& result, const ProbeDirection& direction) {
  ProbeCurve curve;
  curve.direction = direction;
  const std::vector<double> spent = dissipation_of(result);
  for (std::size_t i = 0; i < spent.size(); ++i) {
    curve.strain.push_back(strain_at(result, i));
    curve.stress.push_back(stress_at(result, i));
    curve.dissipated.push_back((spent[i] - spent[0]) / volume_of(result));
  }
  return curve;
}

// -, by the quality table of the run.
std::optional<double> spring_share_of(const StudyResult& result) {
  if (!result.usable || !result.summary.contains("quality")) return std::nullopt;
  for (const auto& figure : result.summary.at("quality"))
    if (figure.at("name") == release_figure) return figure.at("value").get<double>();
  return std::nullopt;
}

}  // namespace

std::string name_of_release(const ProbeState& state) {
  return fmt::format("{},density={},release", state.loading->name, density_name(state.asked));
}
std::string name_of_run(const ProbeState& state, const ProbeDirection& direction) {
  return fmt::format("{},density={},{}", state.loading->name, density_name(state.asked),
                     direction.name);
}

Mandel stress_at_end(const StudyResult& result) {
  return stress_at(result, result.series("time").size() - 1);
}

ProbedPowder ProbeSurface::powder() const {
  return {axis_of(state->in_space()), state->density, state->bonded(), state->stress, centre};
}

std::vector<ProbeState> states_of(const ProbeLoading& loading, const ProbeSpec& spec,
                                  const StudyResult& result, std::vector<std::string>& passed) {
  std::vector<ProbeState> states;
  for (const double density : spec.densities) {
    const std::string name = density_name(density);
    const auto stage = times_of_stage(result, name);
    if (!stage || !std::filesystem::exists(result.folder / state_file(name))) continue;
    ProbeState state{&loading, density};
    const auto value_at = [&](double time, const std::string& series) {
      const std::vector<double>& values = result.series(series);
      return values.empty() ? 0.0 : at_time(result.series("time"), values, time);
    };
    if (const double before = value_at(stage->begin, "relative_density"); before >= density) {
      passed.push_back(fmt::format(
          "{}: the powder already has a relative density of {:.4f} before it is pressed to {:g}",
          loading.name, before, density));
      continue;
    }
    const auto value = [&](const std::string& series) { return value_at(stage->end, series); };
    TensorParts stress{}, fabric{};
    for (std::size_t k = 0; k < tensor_parts; ++k) {
      stress[k] = value(fmt::format("cell/stress_{}", tensor_part_names[k]));
      fabric[k] = value(fmt::format("network/fabric_{}", tensor_part_names[k]));
    }
    if (!loading.scene.scene.in_space()) stress[2] = value("stress/zz");
    state.density = value("relative_density");
    state.stress = mandel_of(stress);
    state.fabric = mandel_of(fabric);
    state.coordination = value("network/coordination");
    states.push_back(state);
  }
  return states;
}

ProbeSurface surface_of(const ProbeState& state, const ProbeSpec& spec, const StudyResult& release,
                        const std::vector<ProbeRun>& runs) {
  ProbeSurface surface;
  surface.state = &state;
  surface.spring_share = spring_share_of(release);
  std::vector<ProbeCurve> curves;
  for (const ProbeRun& run : runs) {
    if (!run.result->usable) continue;
    ProbeCurve curve = curve_of(*run.result, run.direction);
    if (curve.strain.size() < 2) continue;
    surface.centre += curve.stress.front();
    curves.push_back(std::move(curve));
  }
  if (curves.empty()) return surface;
  surface.centre /= static_cast<double>(curves.size());
  surface.moduli = moduli_of(curves, state.in_space(), spec.elastic_strain);
  if (!surface.moduli.known()) return surface;
  for (const ProbeCurve& curve : curves) {
    if (const auto point = offset_yield(curve, surface.moduli, spec.offset_strain))
      surface.offset.push_back(*point);
    if (const auto point =
            dissipation_yield(curve, surface.moduli, spec.dissipation * state.pressure()))
      surface.dissipation.push_back(*point);
  }
  find_normality(surface.offset, surface.centre, spec.directions);
  find_normality(surface.dissipation, surface.centre, spec.directions);
  surface.offset_models = fit_caps(surface.offset, surface.powder());
  surface.dissipation_models = fit_caps(surface.dissipation, surface.powder());
  return surface;
}

}  // namespace pulvis
