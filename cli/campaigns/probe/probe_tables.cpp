#include "cli/campaigns/probe/probe_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/csv_cell.hpp"

namespace pulvis {
namespace {

constexpr int parts = static_cast<int>(tensor_parts);

std::string numbers_text(const Mandel& of, const char* format) {
  std::string text;
  for (const double part : parts_of(of)) text += fmt::format(fmt::runtime(format), part) + ",";
  return text;
}

std::string parameters_text(const FittedModel& model) {
  std::string text;
  for (const auto& [key, value] : model.parameters)
    if (model.determines(key))
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

// As a block says it, in the units of the block: "R: 0.2 to 2.1".
BlockValue block_value(const FittedModel& model, const std::string& name, double unit = 1) {
  if (model.determines(name)) return model.parameter(name);
  const auto range = std::ranges::find(model.ranges, name, &ParameterRange::name);
  const std::string high =
      std::isinf(range->high) ? "no bound" : fmt::format("{:.4g}", range->high * unit);
  return {std::nullopt, fmt::format("{}: {:.4g} to {}", name, range->low * unit, high)};
}

// kg/m^3; 0: the particles are not all of the same.
double solid_density_of(const Scene& scene) {
  double density = 0;
  for (const MaterialSpec& material : scene.materials) {
    if (density > 0 && material.density != density) return 0;
    density = material.density;
  }
  return density;
}

std::string shown(const BlockValue& value, double factor, const char* format, int width) {
  const std::string text =
      value.value ? fmt::format(fmt::runtime(format), *value.value * factor) : "-";
  return fmt::format("{:>{}}", text, width);
}

}  // namespace

std::string points_csv(const std::vector<ProbeSurface>& surfaces) {
  std::string text = "path,seed,relative_density,criterion,direction,set,angle [deg]";
  for (const char* part : tensor_part_names) text += fmt::format(",stress_{} [Pa]", part);
  text += ",p [Pa],q [Pa],lode_angle [deg]";
  for (const char* part : tensor_part_names) text += fmt::format(",plastic_{}", part);
  text += ",angle_to_normal [deg]\n";
  for (const ProbeSurface& surface : surfaces)
    for (const Criterion& criterion : criteria)
      for (const YieldPoint& point : surface.*criterion.points) {
        const auto& [name, set, angle, ignored] = point.direction;
        const bool has_angle =
            set == ProbeDirection::Set::axial || set == ProbeDirection::Set::deviatoric;
        text += fmt::format(
            "{},{},{:.6f},{},{},{},{},{}{:.6e},{:.6e},{:.1f},{}{}\n",
            csv_word(surface.state->loading->history), surface.state->loading->seed,
            surface.state->density, criterion.name, csv_word(name), name_of(set),
            has_angle ? fmt::format("{:.1f}", angle * degrees_in_radian) : "",
            numbers_text(point.stress, "{:.6e}"), point.pressure(), point.deviatoric(),
            lode_angle(point.stress) * degrees_in_radian, numbers_text(point.plastic, "{:.5f}"),
            point.normality ? fmt::format("{:.2f}", *point.normality * degrees_in_radian) : "");
      }
  return text;
}

std::string moduli_csv(const std::vector<ProbeSurface>& surfaces) {
  std::string text = "path,seed,relative_density,pressure [Pa],coordination_number";
  for (const char* part : tensor_part_names) text += fmt::format(",fabric_{}", part);
  for (int row = 1; row <= parts; ++row)
    for (int column = row; column <= parts; ++column)
      text += fmt::format(",c{}{} [Pa]", row, column);
  text +=
      ",youngs_modulus [Pa],poissons_ratio,off_isotropic,off_transversely_isotropic,"
      "off_orthotropic,E_x [Pa],E_y [Pa],E_z [Pa],nu_xy,nu_yz,nu_xz,G_xy [Pa],G_yz [Pa],G_zx [Pa],"
      "released_by_springs\n";
  for (const ProbeSurface& surface : surfaces) {
    const PowderModuli& m = surface.moduli;
    if (!m.known()) continue;
    const ProbeState& state = *surface.state;
    text += fmt::format("{},{},{:.6f},{:.6e},{:.4f},{}", csv_word(state.loading->history),
                        state.loading->seed, state.density, state.pressure(), state.coordination,
                        numbers_text(state.fabric, "{:.5f}"));
    for (int row = 1; row <= parts; ++row)
      for (int column = row; column <= parts; ++column)
        text += m.has(row) && m.has(column) ? fmt::format("{:.6e},", m.c(row, column)) : ",";
    text += fmt::format("{:.6e},{:.5f},", m.youngs_modulus(), m.poissons_ratio());
    if (m.is_complete()) {
      const auto [isotropic, transverse, orthotropic] = m.misfits();
      text += fmt::format("{:.4f},{:.4f},{:.4f},", isotropic, transverse, orthotropic);
      for (const auto& [ignored, value] : m.engineering_constants())
        text += fmt::format("{:.6g},", value);
    } else {
      text += ",,,,,,,,,,,,";
    }
    text += surface.spring_share ? fmt::format("{:.4f}\n", *surface.spring_share) : "\n";
  }
  return text;
}

std::string caps_csv(const std::vector<ProbeGroup>& groups) {
  std::string text =
      "path,seed,relative_density,criterion,model,misfit,parameters,ranges,not_determined\n";
  for (const ProbeGroup& group : groups)
    for (const Criterion& criterion : criteria) {
      const auto rows = [&](const std::string& seed, double density,
                            const std::vector<FittedModel>& models) {
        for (const FittedModel& model : models)
          text += fmt::format("{},{},{:.6f},{},{},{:.5f},{},{}\n", csv_word(group.path()), seed,
                              density, criterion.name, model.name, model.misfit,
                              parameters_text(model), ranges_text(model));
      };
      for (const ProbeSurface* surface : group.surfaces())
        rows(std::to_string(surface->state->loading->seed), surface->state->density,
             surface->*criterion.models);
      rows("all", group.density(), group.fits(criterion));
    }
  return text;
}

std::vector<CapRow> cap_rows(const std::string& path, const std::vector<ProbeGroup>& groups) {
  std::vector<CapRow> rows;
  for (const ProbeGroup& group : groups) {
    if (group.path() != path) continue;
    const auto& models = group.fits(by_dissipation);
    const FittedModel *cap = model_of(models, "drucker_prager_cap"),
                      *clay = model_of(models, "modified_cam_clay");
    if (cap == nullptr || clay == nullptr) continue;
    rows.push_back({group.density(),
                    group.mean([](const ProbeSurface& s) { return s.moduli.youngs_modulus(); }),
                    group.mean([](const ProbeSurface& s) { return s.moduli.poissons_ratio(); }),
                    block_value(*cap, "d"), block_value(*cap, "beta", degrees_in_radian),
                    block_value(*cap, "R"), block_value(*cap, "p_b"), block_value(*clay, "M"),
                    block_value(*clay, "p_c"),
                    solid_density_of(group.surfaces().front()->state->loading->scene.scene)});
  }
  return rows;
}

std::string caps_text(const std::vector<ProbeGroup>& groups) {
  std::string text = fmt::format("{:<16}{:>8}{:>9}{:>9}{:>7}{:>10}{:>9}{:>7}{:>10}{:>8}{:>10}\n",
                                 "path", "density", "E [GPa]", "nu", "points", "d [MPa]", "beta",
                                 "R", "p_b [MPa]", "M", "p_c [MPa]");
  std::string warnings;
  for (const ProbeGroup& group : groups) {
    const std::vector<CapRow> rows = cap_rows(group.path(), {group});
    const std::vector<YieldPoint> pooled = group.pooled(by_dissipation);
    const std::size_t points = usable_points(pooled);
    if (rows.empty()) {
      text += fmt::format(
          "{:<16}{:>8.4f}  {} of {} yield points can be used (no shear probes, pressure "
          ">= 10% and q >= -5% of the largest pressure), a surface needs {}\n",
          group.path(), group.density(), points, pooled.size(), fewest_points);
      continue;
    }
    const CapRow& row = rows[0];
    text += fmt::format("{:<16}{:>8.4f}{:>9.3g}{:>9.3f}{:>7}", group.path(), row.density,
                        row.youngs_modulus * 1e-9, row.poissons_ratio, points) +
            shown(row.d, 1e-6, "{:.3g}", 10) + shown(row.beta, degrees_in_radian, "{:.1f}", 9) +
            shown(row.r, 1, "{:.3f}", 7) + shown(row.p_b, 1e-6, "{:.4g}", 10) +
            shown(row.m, 1, "{:.3f}", 8) + shown(row.p_c, 1e-6, "{:.4g}", 10) + "\n";
    for (const FittedModel& model : group.fits(by_dissipation))
      if (const std::string open = undetermined(model); !open.empty())
        warnings += fmt::format(
            "warning: {} at {:.4f}, {}: the yield points do not determine {}: values in these "
            "ranges fit as well\n",
            group.path(), row.density, model.name, open);
  }
  return text + warnings;
}

}  // namespace pulvis
