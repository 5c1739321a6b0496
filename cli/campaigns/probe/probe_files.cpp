#include "cli/campaigns/probe/probe_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "cli/campaigns/probe/keyword_blocks.hpp"
#include "cli/csv_cell.hpp"
#include "cli/report/report_page.hpp"
#include "cli/summary.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

struct Criterion {
  const char* name;
  std::vector<YieldPoint> ProbeSurface::*points;
  std::vector<FittedModel> ProbeSurface::*models;
};
constexpr std::array criteria{
    Criterion{"offset_strain", &ProbeSurface::offset, &ProbeSurface::offset_models},
    Criterion{"dissipation", &ProbeSurface::dissipation, &ProbeSurface::dissipation_models}};

// All surfaces of a path at a density: one per seed.
struct Group {
  std::string path;
  double asked;
  std::vector<const ProbeSurface*> surfaces;

  double mean(const std::function<double(const ProbeSurface&)>& of) const {
    double sum = 0;
    for (const ProbeSurface* surface : surfaces) sum += of(*surface);
    return sum / static_cast<double>(surfaces.size());
  }
  double density() const {
    return mean([](const ProbeSurface& s) { return s.state->density; });
  }
  std::vector<YieldPoint> pooled(const Criterion& criterion) const {
    std::vector<YieldPoint> all;
    for (const ProbeSurface* surface : surfaces)
      all.insert(all.end(), (surface->*criterion.points).begin(),
                 (surface->*criterion.points).end());
    return all;
  }
  const std::vector<FittedModel>& fits(const Criterion& criterion) const {
    return models[static_cast<std::size_t>(&criterion - criteria.data())];
  }
  void fit() {
    for (std::size_t i = 0; i < criteria.size(); ++i)
      models[i] = fit_caps(pooled(criteria[i]), density(), surfaces.front()->state->bonded);
  }

  std::array<std::vector<FittedModel>, criteria.size()> models = {};
};

std::vector<Group> groups_of(const Probe& probe, const std::vector<ProbeSurface>& surfaces) {
  std::vector<Group> groups;
  for (const ProbePath& path : probe.spec.paths)
    for (const double density : probe.spec.densities) {
      Group group{path.name, density, {}, {}};
      for (const ProbeSurface& surface : surfaces)
        if (surface.state->path == path.name && surface.state->asked == density)
          group.surfaces.push_back(&surface);
      if (group.surfaces.empty()) continue;
      group.fit();
      groups.push_back(std::move(group));
    }
  return groups;
}

std::string points_csv(const std::vector<ProbeSurface>& surfaces) {
  std::string text =
      "path,seed,relative_density,criterion,direction [deg],stress_xx [Pa],stress_yy [Pa],"
      "stress_xy [Pa],stress_zz [Pa],p [Pa],q [Pa],plastic_xx,plastic_yy,angle_to_normal [deg]\n";
  for (const ProbeSurface& surface : surfaces)
    for (const Criterion& criterion : criteria)
      for (const YieldPoint& point : surface.*criterion.points) {
        const auto& s = point.stress;
        text += fmt::format(
            "{},{},{:.6f},{},{:.1f},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},"
            "{:.5f},{:.5f},{}\n",
            csv_word(surface.state->path), surface.state->seed, surface.state->density,
            criterion.name, point.angle * degrees_in_radian, s[0], s[1], s[2], s[3],
            point.pressure(), point.deviatoric(), point.plastic[0], point.plastic[1],
            point.normality ? fmt::format("{:.2f}", *point.normality * degrees_in_radian) : "");
      }
  return text;
}

std::string moduli_csv(const std::vector<ProbeSurface>& surfaces) {
  std::string text =
      "path,seed,relative_density,pressure [Pa],c11 [Pa],c12 [Pa],c22 [Pa],shear_modulus [Pa],"
      "youngs_modulus [Pa],poissons_ratio,released_by_springs\n";
  for (const ProbeSurface& surface : surfaces) {
    const PowderModuli& m = surface.moduli;
    text += fmt::format("{},{},{:.6f},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},{:.5f},{}\n",
                        csv_word(surface.state->path), surface.state->seed, surface.state->density,
                        surface.state->pressure, m.c11, m.c12, m.c22, m.g, m.youngs_modulus(),
                        m.poissons_ratio(),
                        surface.spring_share ? fmt::format("{:.4f}", *surface.spring_share) : "");
  }
  return text;
}

std::string parameters_text(const FittedModel& model) {
  std::string text;
  for (const auto& [key, value] : model.parameters)
    text += fmt::format("{}{}={:.6g}", text.empty() ? "" : " ", key, value);
  return text;
}

// Two cells: the ranges of all parameters, and the names of those that the points do not determine.
std::string ranges_text(const FittedModel& model) {
  std::string ranges, open;
  for (const ParameterRange& range : model.ranges) {
    ranges += fmt::format("{}{}={:.4g}..{:.4g}", ranges.empty() ? "" : " ", range.name, range.low,
                          range.high);
    if (!range.determined) open += (open.empty() ? "" : " ") + range.name;
  }
  return ranges + "," + open;
}

std::string caps_csv(const std::vector<Group>& groups) {
  std::string text =
      "path,seed,relative_density,criterion,model,misfit,parameters,ranges,not_determined\n";
  for (const Group& group : groups)
    for (const Criterion& criterion : criteria) {
      const auto add = [&](const std::string& seed, double density,
                           const std::vector<FittedModel>& models) {
        for (const FittedModel& model : models)
          text += fmt::format("{},{},{:.6f},{},{},{:.4f},{},{}\n", csv_word(group.path), seed,
                              density, criterion.name, model.name, model.misfit,
                              parameters_text(model), ranges_text(model));
      };
      for (const ProbeSurface* surface : group.surfaces)
        add(std::to_string(surface->state->seed), surface->state->density,
            surface->*criterion.models);
      add("all", group.density(), group.fits(criterion));
    }
  return text;
}

Json model_json(const FittedModel& model) {
  Json json{{"name", model.name}, {"in_plane", model.in_plane}, {"misfit", model.misfit}};
  for (const auto& [key, value] : model.parameters) json["parameters"][key] = value;
  json["not_determined"] = Json::array();
  for (const ParameterRange& range : model.ranges) {
    json["ranges"][range.name] = {range.low, range.high};  // null: no upper bound
    if (!range.determined) json["not_determined"].push_back(range.name);
  }
  for (const auto& [p, q] : model.surface) json["surface"].push_back({p, q});
  return json;
}

Json point_json(const YieldPoint& point, const ProbeState& state) {
  Json json{{"run", name_of_run(state, point.angle)},
            {"direction", point.angle},
            {"stress", point.stress},
            {"p", point.pressure()},
            {"q", point.deviatoric()},
            {"plane_p", point.plane_pressure()},
            {"plane_shear", point.plane_shear()},
            {"plastic", point.plastic}};
  if (point.normality) json["angle_to_normal"] = *point.normality;
  return json;
}

// Mean and standard deviation of a parameter over the seeds.
Json scatter_json(const Group& group, const Criterion& criterion, const FittedModel& pooled) {
  Json json = Json::object();
  for (const auto& [key, ignored] : pooled.parameters) {
    double n = 0, sum = 0, squares = 0;
    for (const ProbeSurface* surface : group.surfaces)
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

Json group_json(const Group& group) {
  Json json{{"path", group.path}, {"asked", group.asked}, {"relative_density", group.density()}};
  for (const ProbeSurface* surface : group.surfaces) {
    const PowderModuli& m = surface->moduli;
    json["states"].push_back({{"run", surface->state->loading},
                              {"seed", surface->state->seed},
                              {"relative_density", surface->state->density},
                              {"stress", surface->state->stress},
                              {"pressure", surface->state->pressure},
                              {"c11", m.c11},
                              {"c12", m.c12},
                              {"c22", m.c22},
                              {"shear_modulus", m.g},
                              {"youngs_modulus", m.youngs_modulus()},
                              {"poissons_ratio", m.poissons_ratio()}});
    if (surface->spring_share)
      json["states"].back()["released_by_springs"] = *surface->spring_share;
  }
  for (const Criterion& criterion : criteria) {
    Json& mine =
        json["yield"][criterion.name] = {{"points", Json::array()}, {"models", Json::array()}};
    const std::vector<bool> fitted = usable(group.pooled(criterion));
    for (const ProbeSurface* surface : group.surfaces)
      for (const YieldPoint& point : surface->*criterion.points) {
        const bool is_fitted = fitted[mine["points"].size()];
        mine["points"].push_back(point_json(point, *surface->state));
        mine["points"].back()["fitted"] = is_fitted;
      }
    for (const FittedModel& model : group.fits(criterion)) {
      mine["models"].push_back(model_json(model));
      mine["models"].back()["scatter"] = scatter_json(group, criterion, model);
    }
  }
  return json;
}

// A row for every density of the path that has a cap, by the dissipated energy: where a powder comes apart, plastic strain
// grows but nothing is dissipated.
std::vector<CapRow> cap_rows(const std::string& path, const std::vector<Group>& groups) {
  std::vector<CapRow> rows;
  for (const Group& group : groups) {
    if (group.path != path) continue;
    const auto& models = group.fits(criteria[1]);
    if (models.empty()) continue;
    const FittedModel &cap = models[0], &clay = models[1];
    rows.push_back({group.density(),
                    group.mean([](const ProbeSurface& s) { return s.moduli.youngs_modulus(); }),
                    group.mean([](const ProbeSurface& s) { return s.moduli.poissons_ratio(); }),
                    cap.parameter("d"), cap.parameter("beta"), cap.parameter("R"),
                    cap.parameter("p_b"), clay.parameter("M"), clay.parameter("p_c"),
                    undetermined(cap), undetermined(clay)});
  }
  return rows;
}

}  // namespace

void write_probe(const std::filesystem::path& folder, const Probe& probe,
                 const std::vector<ProbeSurface>& surfaces, double wall_seconds) {
  const std::vector<Group> groups = groups_of(probe, surfaces);
  write_own(folder / "yield_points.csv", role::probe, points_csv(surfaces));
  write_own(folder / "moduli.csv", role::probe, moduli_csv(surfaces));
  write_own(folder / "caps.csv", role::probe, caps_csv(groups));
  for (const ProbePath& path : probe.spec.paths) {
    const std::vector<CapRow> rows = cap_rows(path.name, groups);
    if (rows.empty()) continue;
    write_own(folder / (path.name + ".inp"), role::probe, abaqus_block(path.name, rows));
    write_own(folder / (path.name + ".comm"), role::probe, code_aster_block(path.name, rows));
  }
  Json json{{"title", probe.spec.title},
            {"version", program_version()},
            {"commit", program_commit()},
            {"wall_seconds", wall_seconds},
            {"offset_strain", probe.spec.offset_strain},
            {"dissipation", probe.spec.dissipation},
            {"states", Json::array()}};
  for (const Group& group : groups) json["states"].push_back(group_json(group));
  write_own(folder / "summary.json", role::probe, json.dump(1) + "\n");
  write_page(folder / "report.html", "probe.html",
             {"units.js", "names.js", "payload.js", "save.js", "chart.js", "maps.js", "settings.js",
              "tables.js", "probe.js"},
             {probe.spec.title, json.dump(-1, ' ', false, Json::error_handler_t::replace), {}},
             role::probe);
}

std::string caps_text(const Probe& probe, const std::vector<ProbeSurface>& surfaces) {
  std::string text = fmt::format("{:<16}{:>8}{:>9}{:>9}{:>7}{:>10}{:>9}{:>7}{:>10}{:>8}{:>10}\n",
                                 "path", "density", "E [GPa]", "nu", "points", "d [MPa]", "beta",
                                 "R", "p_b [MPa]", "M", "p_c [MPa]");
  std::string warnings;
  for (const Group& group : groups_of(probe, surfaces)) {
    const std::vector<CapRow> rows = cap_rows(group.path, {group});
    const std::vector<YieldPoint> pooled = group.pooled(criteria[1]);
    const std::size_t points = usable_points(pooled);
    if (rows.empty()) {
      text += fmt::format(
          "{:<16}{:>8.4f}  {} of {} yield points can be used (in-plane pressure >= 10% and "
          "q >= -5% of the largest pressure), a surface needs {}\n",
          group.path, group.density(), points, pooled.size(), fewest_points);
      continue;
    }
    const CapRow& row = rows[0];
    text += fmt::format(
        "{:<16}{:>8.4f}{:>9.3g}{:>9.3f}{:>7}{:>10.3g}{:>9.1f}{:>7.3f}{:>10.4g}{:>8.3f}{:>10.4g}\n",
        group.path, row.density, row.youngs_modulus * 1e-9, row.poissons_ratio, points,
        row.d * 1e-6, row.beta * degrees_in_radian, row.r, row.p_b * 1e-6, row.m, row.p_c * 1e-6);
    for (const std::string& open : {row.open_cap, row.open_clay})
      if (!open.empty())
        warnings += fmt::format(
            "warning: {} at {:.4f}: the yield points do not determine {}: values in these ranges "
            "fit as well\n",
            group.path, row.density, open);
  }
  return text + warnings;
}

}  // namespace pulvis
