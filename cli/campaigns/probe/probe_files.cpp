#include "cli/campaigns/probe/probe_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/campaigns/probe/probe_tables.hpp"
#include "cli/report/report_page.hpp"
#include "cli/summary.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

// null: not determined, so that nobody takes it for a number.
Json model_json(const FittedModel& model) {
  Json json{{"name", model.name},
            {"in_plane", model.terms == YieldModel::Terms::plane},
            {"in_stresses", model.terms == YieldModel::Terms::stress},
            {"misfit", model.misfit}};
  for (const auto& [key, value] : model.parameters)
    json["parameters"][key] = model.determines(key) ? Json(value) : Json(nullptr);
  json["not_determined"] = Json::array();
  for (const ParameterRange& range : model.ranges) {
    json["ranges"][range.name] = {range.low, range.high};  // null: no upper bound
    if (!range.determined) json["not_determined"].push_back(range.name);
  }
  for (const auto& [p, q] : model.surface) json["surface"].push_back({p, q});
  if (!model.shell.empty()) json["shell"] = model.shell;
  return json;
}

// Components in the axial plane, pressures and shortening > 0: across and along the axis.
std::array<double, 2> in_axial_plane(const Mandel& of, Axis axis) {
  const AxialPlane plane = axial_plane(axis);
  return {-of.dot(plane.across), -of.dot(plane.along)};
}

Json point_json(const YieldPoint& point, const ProbeState& state) {
  using Set = ProbeDirection::Set;
  const ProbeDirection& direction = point.direction;
  Json json{{"run", name_of_run(state, direction)},
            {"direction", direction.name},
            {"set", name_of(direction.set)},
            {"stress", parts_of(point.stress)},
            {"p", point.pressure()},
            {"q", point.deviatoric()},
            {"plastic", parts_of(point.plastic)}};
  if (direction.set == Set::axial || direction.set == Set::deviatoric)
    json["angle"] = direction.angle;
  if (direction.set == Set::axial) {
    json["across_along"] = in_axial_plane(point.stress, point.axis);
    json["plastic_across_along"] = in_axial_plane(point.plastic, point.axis);
  }
  if (state.in_space())
    json["lode_angle"] = lode_angle(point.stress);
  else
    json["plane_p"] = point.plane_pressure(), json["plane_shear"] = point.plane_shear();
  if (point.normality) json["angle_to_normal"] = *point.normality;
  return json;
}

Json moduli_json(const PowderModuli& m) {
  Json json{{"youngs_modulus", m.youngs_modulus()}, {"poissons_ratio", m.poissons_ratio()}};
  if (m.has(4)) json["shear_modulus"] = m.c(4, 4);
  for (int row = 1; row <= static_cast<int>(tensor_parts); ++row)
    for (int column = row; column <= static_cast<int>(tensor_parts); ++column)
      if (m.has(row) && m.has(column))
        json["stiffness"][fmt::format("c{}{}", row, column)] = m.c(row, column);
  if (!m.is_complete()) return json;
  const auto [isotropic, transverse, orthotropic] = m.misfits();
  json["off"] = {{"isotropic", isotropic},
                 {"transversely_isotropic", transverse},
                 {"orthotropic", orthotropic}};
  for (const auto& [name, value] : m.engineering_constants()) json["engineering"][name] = value;
  return json;
}

Json state_json(const ProbeSurface& surface) {
  const ProbeState& state = *surface.state;
  Json json{{"run", state.loading->name},
            {"seed", state.loading->seed},
            {"relative_density", state.density},
            {"stress", parts_of(state.stress)},
            {"across_along", in_axial_plane(state.stress, axis_of(state.in_space()))},
            {"pressure", state.pressure()},
            {"q", von_mises_of(state.stress)},
            {"coordination", state.coordination},
            {"fabric", parts_of(state.fabric)}};
  json.update(moduli_json(surface.moduli));
  if (surface.spring_share) json["released_by_springs"] = *surface.spring_share;
  return json;
}

// Mean and standard deviation of a parameter over the seeds.
Json scatter_json(const ProbeGroup& group, const Criterion& criterion, const FittedModel& pooled) {
  Json json = Json::object();
  for (const auto& [key, ignored] : pooled.parameters) {
    if (!pooled.determines(key)) continue;
    double n = 0, sum = 0, squares = 0;
    for (const ProbeSurface* surface : group.surfaces())
      for (const FittedModel& model : surface->*criterion.models)
        if (model.name == pooled.name) {
          const double value = model.parameter(key);
          n += 1, sum += value, squares += value * value;
        }
    if (n < 2) continue;
    const double mean = sum / n;
    json[key] = {{"mean", mean},
                 {"deviation", std::sqrt(std::max(0.0, (squares - n * mean * mean) / (n - 1)))}};
  }
  return json;
}

Json group_json(const ProbeGroup& group) {
  Json json{{"path", group.path()},
            {"asked", group.asked()},
            {"relative_density", group.density()},
            {"dimension", group.in_space() ? 3 : 2}};
  for (const ProbeSurface* surface : group.surfaces())
    json["states"].push_back(state_json(*surface));
  for (const Criterion& criterion : criteria) {
    Json& mine =
        json["yield"][criterion.name] = {{"points", Json::array()}, {"models", Json::array()}};
    const std::vector<bool> fitted = usable(group.pooled(criterion)),
                            turned = closed(group.pooled(criterion));
    for (const ProbeSurface* surface : group.surfaces())
      for (const YieldPoint& point : surface->*criterion.points) {
        const std::size_t i = mine["points"].size();
        mine["points"].push_back(point_json(point, *surface->state));
        mine["points"].back()["fitted"] = static_cast<bool>(fitted[i]);
        mine["points"].back()["fitted_in_stresses"] = static_cast<bool>(turned[i]);
      }
    for (const FittedModel& model : group.fits(criterion)) {
      mine["models"].push_back(model_json(model));
      mine["models"].back()["scatter"] = scatter_json(group, criterion, model);
    }
  }
  return json;
}

}  // namespace

void write_probe(const std::filesystem::path& folder, const Probe& probe,
                 const std::vector<ProbeSurface>& surfaces, const std::vector<ProbeGroup>& groups,
                 double wall_seconds) {
  write_own(folder / "yield_points.csv", role::probe, points_csv(surfaces));
  write_own(folder / "moduli.csv", role::probe, moduli_csv(surfaces));
  write_own(folder / "caps.csv", role::probe, caps_csv(groups));
  for (const std::string& history : probe.histories) {
    const std::vector<CapRow> rows = cap_rows(history, groups);
    // A block of an earlier run, which the points do not give any more, must not stay.
    const auto write = [&](const char* ending, const std::string& block) {
      const std::filesystem::path file = folder / (history + ending);
      if (block.empty())
        std::filesystem::remove(file);
      else
        write_own(file, role::probe, block);
    };
    write(".inp", rows.empty() ? "" : abaqus_block(history, rows));
    write(".comm", code_aster_block(history, rows));
    write(".k", ls_dyna_block(history, rows));
  }
  Json json{{"title", probe.spec.title},
            {"version", program_version()},
            {"commit", program_commit()},
            {"wall_seconds", wall_seconds},
            {"offset_strain", probe.spec.offset_strain},
            {"dissipation", probe.spec.dissipation},
            {"states", Json::array()}};
  for (const ProbeGroup& group : groups) json["states"].push_back(group_json(group));
  write_own(folder / "summary.json", role::probe, json.dump(1) + "\n");
  write_page(folder / "report.html", "probe.html",
             {"units.js", "names.js", "payload.js", "save.js", "chart.js", "maps.js", "settings.js",
              "tables.js", "probe_space.js", "probe.js"},
             {probe.spec.title, json.dump(-1, ' ', false, Json::error_handler_t::replace), {}},
             role::probe);
}

}  // namespace pulvis
