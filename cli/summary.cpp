#include "cli/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/summary_compaction.hpp"
#include "cli/tell.hpp"
#include "components/contact.hpp"
#include "engine/enum_table.hpp"
#include "engine/files/own_files.hpp"
#include "engine/instruction_set.hpp"
#include "scenes/results/bond_results.hpp"
#include "scenes/spec/dimension_words.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/tools/surface.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

Json components_json(const Scene& scene, const double* v) {
  const std::span<const double> components = components_of(scene, v);
  return Json(std::vector<double>(components.begin(), components.end()));
}

// `at`: its position, m.
void add_geometry(const Scene& scene, const ToolSpec& tool, const double* at, Json& json) {
  using Shape = ToolSpec::Shape;
  const bool drawn = tool.shape == Shape::polyline;
  if (!drawn && tool.shape != Shape::constraint) json["point"] = components_json(scene, at);
  if (!drawn && tool.shape != Shape::constraint && tool.shape != Shape::stl)
    json["normal"] = components_json(scene, tool.normal.data());
  if (drawn)
    for (const Vec2& p : drawn_points(make_surface(tool.points, tool.rounding)))
      json["points"].push_back({at[0] + p.x(), at[1] + p.y()});
  if (tool.diameter > 0) json["diameter"] = tool.diameter;
  for (const Vec2& p : tool.profile) json["profile"].push_back({p.x(), p.y()});
}

Json tools_json(const Scene& scene, const World& world) {
  Json tools = Json::array();
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& spec = scene.tools[t];
    Json tool{{"name", spec.name}, {"shape", tool_shape_names[spec.shape]}};
    add_geometry(scene, spec, world.column<ToolPosition>().values() + tool_axes * t, tool);
    tool["force"] = components_json(scene, world.column<ToolForce>().values() + tool_axes * t);
    tools.push_back(tool);
  }
  return tools;
}

Json materials_json(const Scene& scene) {
  Json materials = Json::array();
  for (const MaterialSpec& m : scene.materials) {
    Json entry{{"name", m.name},
               {"density", m.density},
               {"youngs_modulus", m.youngs_modulus},
               {"poissons_ratio", m.poissons_ratio}};
    if (m.yield_stress) {
      entry["yield_stress"] = *m.yield_stress;
      if (m.flow)
        entry["hardening"] = name_of(*m.flow);
      else
        entry["hardening_modulus"] = m.hardening_modulus;
    }
    if (m.damped())
      entry["damping"] = {{"mass_proportional", m.mass_damping},
                          {"stiffness_proportional", m.stiffness_damping}};
    materials.push_back(entry);
  }
  return materials;
}

std::int64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

Json limits_json(const LimitSpec& limits) {
  Json json{{"energy_balance", limits.energy_balance},
            {"penetration", limits.penetration},
            {"unconverged_projections", limits.unconverged_projections}};
  if (limits.kinetic_energy) json["kinetic_energy"] = *limits.kinetic_energy;
  return json;
}

void add_figures(Json& json, const Results& results) {
  json["energy_balance_error"] = results.energy_balance_error();
  json["kinetic_ratio"] = results.kinetic_ratio();
  json["min_jacobian"] = results.min_jacobian();
  for (const char* name :
       {"penetration", "relative_density", "stress_ratio/axial", "stress_ratio/lateral"})
    if (results.has(name)) json[name] = results.value(name);
}

void add_quality(Json& json, const World& world, const RunQuality& quality) {
  const ContactFindings& found = quality.contacts;
  Json contacts = Json::object();
  if (found.narrow_share) contacts["narrow_share"] = *found.narrow_share;
  if (found.narrow_edges > 0) {
    contacts["narrow_edges"] = found.narrow_edges;
    contacts["edge_to_do"] = found.edge_to_do;
  }
  if (found.force_error) contacts["force_error"] = *found.force_error;
  const Totals& totals = world.resource<Totals>();
  contacts["projections"] = totals.projections;
  contacts["unconverged_projections"] = totals.unconverged;
  contacts["unconverged_share"] = totals.unconverged_share();
  json["contact_quality"] = contacts;
  json["quality"] = Json::array();
  for (const QualityFigure& figure : quality.figures) {
    Json entry{{"name", figure.name}, {"meaning", figure.meaning}, {"value", figure.value}};
    if (figure.limit) entry["limit"] = *figure.limit;
    if (figure.beyond()) {
      entry["line"] = figure.line();
      entry["advice"] = figure.advice;
    }
    json["quality"].push_back(entry);
  }
  for (const std::string& line : quality.warnings) json["warnings"].push_back(line);
}

Json expectations_json(const std::vector<Verdict>& verdicts) {
  Json list = Json::array();
  for (const Verdict& verdict : verdicts) {
    Json entry{{"what", verdict.what},
               {"measured", verdict.measured},
               {"expected", verdict.allowed},
               {"met", verdict.met}};
    if (verdict.value) entry["value"] = *verdict.value;
    list.push_back(entry);
  }
  return list;
}

void add_stages(Json& json, const World& world) {
  if (!world.has<ToolProgram>()) return;
  const double now = world.resource<Clock>().time;
  for (const ToolProgram::Stage& stage : world.resource<ToolProgram>().stages)
    if (stage.begin < now || stage.begin == 0)
      json["stages"].push_back(
          {{"name", stage.name}, {"begin", stage.begin}, {"end", std::min(stage.end, now)}});
}

void add_shear(Json& json, const Results& results) {
  const auto figures = results.shear().figures();
  if (!figures) return;
  const auto of = [](const std::optional<double>& figure) {
    return figure ? Json(*figure) : Json();
  };
  json["shear"] = {{"distance", figures->distance},
                   {"static_friction", of(figures->static_friction)},
                   {"dynamic_friction", of(figures->dynamic_friction)},
                   {"dynamic_deviation", of(figures->dynamic_deviation)},
                   {"normal_stress", of(figures->normal_stress)},
                   {"dilation", of(figures->dilation)}};
}

Json diameters_json(const BondFindings& found, SizeDistribution::Weight weight) {
  const SizeDistribution sizes(found.fragments, weight, found.space ? 3 : 2);
  return {{"d10", sizes.diameter(0.1)}, {"d50", sizes.diameter(0.5)}, {"d90", sizes.diameter(0.9)}};
}

void add_bonds(Json& json, const World& world) {
  const auto found = bond_findings(world);
  if (!found) return;
  using Weight = SizeDistribution::Weight;
  Json bonds{{"made", found->made},
             {"broken", found->broken},
             {found->space ? "crack_area" : "crack_length", found->crack_size},
             {"fracture_energy", found->fracture_energy},
             {"crack_energy", found->crack_energy}};
  if (found->shear_share) bonds["mode_2_share"] = *found->shear_share;
  if (found->damage) bonds["damage"] = *found->damage;
  bonds["fragments"] = found->fragments.size();
  bonds["largest_fragment"] = found->largest_share;
  bonds["diameter_by_number"] = diameters_json(*found, Weight::number);
  bonds[found->space ? "diameter_by_volume" : "diameter_by_area"] =
      diameters_json(*found, Weight::size);
  json["bonds"] = bonds;
}

Json ranks_json(const RunCost& cost) {
  Json rebalancings = Json::array();
  for (const Rebalancing& one : cost.rebalancings)
    rebalancings.push_back({{"step", one.step},
                            {"chunks", one.chunks},
                            {"seconds", one.seconds},
                            {"seconds_a_step_before", one.before},
                            {"seconds_a_step_after", one.after}});
  return {{"count", cost.rank_memory.size()},
          {"bytes_a_step", cost.bytes_a_step},
          {"peak_memory_bytes", cost.rank_memory},
          {"seconds_a_step", cost.rank_seconds},
          {"rebalancings", rebalancings}};
}

}  // namespace

void print_summary(const std::filesystem::path& folder) {
  std::ostringstream text;
  text << std::ifstream(folder / "summary.json").rdbuf();
  put(stdout, text.str());
}

std::vector<std::string> RunQuality::lines() const {
  std::vector<std::string> all = warnings;
  for (const QualityFigure& figure : figures)
    if (figure.beyond()) all.push_back(figure.line());
  return all;
}

void write_summary(const std::filesystem::path& folder, const Scene& scene, const World& world,
                   const Results& results, const CompactionCurve& curve, const RunQuality& quality,
                   const RunCost& cost, const std::vector<Verdict>& verdicts) {
  const double updates = static_cast<double>(cost.steps) * static_cast<double>(results.elements());
  Json json{{"title", scene.title},
            {"outcome", cost.outcome},
            {"version", program_version()},
            {"commit", program_commit()},
            {"scene_hash", cost.scene_hash},
            {"seed", scene.seed},
            {"threads", cost.threads},
            {"instruction_set", instruction_set()},
            {"wall_seconds", cost.wall_seconds},
            {"time", world.resource<Clock>().time},
            {"steps", cost.steps},
            {"state_hash", cost.state_hash},
            {"particles", world.resource<Bodies>().particles()},
            {"elements", results.elements()},
            {"element_updates_per_second", cost.wall_seconds > 0 ? updates / cost.wall_seconds : 0},
            {"peak_memory_bytes", peak_memory()}};
  if (!cost.rank_memory.empty()) json["ranks"] = ranks_json(cost);
  if (scene.in_space())
    json["dimension"] = 3;
  else
    json["thickness"] = scene.thickness;
  add_figures(json, results);
  add_quality(json, world, quality);
  if (const Json steps = quality.steps.json(scene); !steps.empty()) json["time_step"] = steps;
  json["limits"] = limits_json(scene.limits);
  json["tools"] = tools_json(scene, world);
  json["materials"] = materials_json(scene);
  add_stages(json, world);
  add_shear(json, results);
  add_bonds(json, world);
  add_compaction(json, scene, curve);
  for (const SystemCost& system : cost.systems)
    json["cost"].push_back({{"system", system.system}, {"seconds", system.seconds}});
  if (!verdicts.empty()) json["expectations"] = expectations_json(verdicts);
  write_own(folder / "summary.json", role::run, json.dump(2) + "\n");
}

}  // namespace pulvis
