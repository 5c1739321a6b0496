#include "tests/helpers/synthetic_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/files/own_files.hpp"
#include "engine/files/recorder.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis::testing {
namespace {

constexpr double duration = 1e-3, yield = 290e6;

struct Point {
  double x = 0, y = 0;
};

// A square's points moved onto a disc of radius 1, and back towards the square as `flat` goes to 1.
Point on_disc(double u, double v, double flat) {
  const double x = u * std::sqrt(1 - v * v / 2), y = v * std::sqrt(1 - u * u / 2);
  return {x + flat * (u - x), y + flat * (v - y)};
}

double squeeze(double share) { return 1 - 0.2 * share; }  // height of the compact, of its first one

int side(const SyntheticRun& run) { return run.divisions + 1; }

std::vector<double> positions(const SyntheticRun& run, double share) {
  std::vector<double> xy;
  for (int disc = 0; disc < run.rows * run.columns; ++disc) {
    for (int node = 0; node < side(run) * side(run); ++node) {
      const double u = 2.0 * (node % side(run)) / run.divisions - 1;
      const double v = 2.0 * (node / side(run)) / run.divisions - 1;
      const Point at = on_disc(u, v, 0.85 * share);
      xy.push_back(run.diameter * (disc % run.columns + 0.5 + at.x / 2));
      xy.push_back(run.diameter * (disc / run.columns + 0.5 + at.y / 2) * squeeze(share));
    }
  }
  return xy;
}

const std::vector<std::string> tool_names{"top", "bottom", "left", "right"};

// Columns of steel and of copper, one class; four tools of four corners each.
void add_tags(const SyntheticRun& run, RunMesh& mesh) {
  ParticleTag number{"number", "particle", "of the particle", {}, {}};
  ParticleTag material{"material", "material", "position in `names`", {}, {"steel", "copper"}};
  ParticleTag of_class{"class", "class", "position in `names`", {}, {"disc"}};
  for (int disc = 0; disc < run.rows * run.columns; ++disc) {
    number.values.push_back(disc);
    material.values.push_back(disc % run.columns % 2);
    of_class.values.push_back(0);
  }
  mesh.tags = {number, material, of_class};
  mesh.tools.names = tool_names;
  for (int corner = 0; corner < 16; ++corner) {
    const int first = corner / 4 * 4;
    mesh.tools.ends.insert(mesh.tools.ends.end(), {corner, first + (corner + 1) % 4});
    mesh.tools.tool.push_back(corner / 4);
  }
}

// Faces, then the corners behind them.
std::vector<double> tool_corners(const SyntheticRun& run, double share) {
  const double w = run.columns * run.diameter, h = run.rows * run.diameter, t = 0.1 * w;
  const double top = h * squeeze(share);
  return {0, top, w, top,   w,  top + t, 0,  top + t, 0, 0,  w, 0,     w,     -t,    0,     -t,
          0, -t,  0, h + t, -t, h + t,   -t, -t,      w, -t, w, h + t, w + t, h + t, w + t, -t};
}

RunMesh mesh_of(const SyntheticRun& run) {
  RunMesh mesh;
  const int nodes = side(run) * side(run);
  for (int disc = 0; disc < run.rows * run.columns; ++disc) {
    mesh.node_particle.insert(mesh.node_particle.end(), static_cast<std::size_t>(nodes), disc);
    for (int cell = 0; cell < run.divisions * run.divisions; ++cell) {
      const int first = disc * nodes + cell / run.divisions * side(run) + cell % run.divisions;
      mesh.quads.insert(mesh.quads.end(),
                        {first, first + 1, first + side(run) + 1, first + side(run)});
      mesh.cell_particle.push_back(disc);
    }
  }
  mesh.reference = positions(run, 0);
  if (run.tools) add_tags(run, mesh);
  return mesh;
}

// High where discs touch, with a little of each disc's own.
std::vector<double> stresses(const SyntheticRun& run, double share) {
  std::vector<double> values;
  for (int disc = 0; disc < run.rows * run.columns; ++disc) {
    for (int cell = 0; cell < run.divisions * run.divisions; ++cell) {
      const double u = 2.0 * (cell % run.divisions + 0.5) / run.divisions - 1;
      const double v = 2.0 * (cell / run.divisions + 0.5) / run.divisions - 1;
      const double reach = 0.35 + 0.65 * std::max(std::abs(u), std::abs(v));
      values.push_back(yield * share * std::min(1.2, reach * (1.1 + 0.15 * std::sin(3.7 * disc))));
    }
  }
  return values;
}

std::vector<FieldInfo> fields(const SyntheticRun& run) {
  std::vector<FieldInfo> all{
      {"position", "m", "position $x$", "position of the node", FieldPlace::node, 2},
      {"velocity", "m/s", "velocity $v$", "velocity of the node", FieldPlace::node, 2},
      {"effective_stress", "Pa", "effective stress $\\sigma_\\mathrm{eff}$", "von Mises stress",
       FieldPlace::cell, 1},
      {"plastic_strain", "-", "plastic strain $\\bar\\varepsilon_p$", "accumulated plastic strain",
       FieldPlace::cell, 1},
      {"stress", "Pa", "stress $\\sigma$", "Cauchy stress xx, yy, zz, xy", FieldPlace::cell, 4}};
  const auto add = [&](const std::string& name, const char* unit, FieldPlace place, int components,
                       bool whole = false) {
    all.push_back({name, unit, "", "made up", place, components, whole});
  };
  if (run.cell) add("cell", "m", FieldPlace::list, 2);
  if (run.bonds) {
    for (const std::string name : {"bonds/start", "bonds/end", "cracks/start", "cracks/end"})
      add(name, "m", FieldPlace::list, 2);
    add("bonds/length", "m", FieldPlace::list, 1);
    add("fragments/number", "-", FieldPlace::list, 1, true);
    add("fragments/area", "m^2", FieldPlace::list, 1);
    add("fragment", "-", FieldPlace::particle, 1, true);
    add("damage", "-", FieldPlace::particle, 1);
  }
  if (run.tools) add("tools/outline", "m", FieldPlace::list, 2);
  if (!run.observed) return all;
  add("particle_centre", "m", FieldPlace::particle, 2);
  add("force_chain", "-", FieldPlace::particle, 1, true);
  add("local_density", "-", FieldPlace::list, 2);
  add("density_profile", "-", FieldPlace::list, 1);
  add("density_grid/x", "m", FieldPlace::list, 1);
  add("density_grid/y", "m", FieldPlace::list, 1);
  for (const std::string group : {"contacts/", "tool_contacts/"}) {
    add(group + "ids", "-", FieldPlace::list, 2, true);
    add(group + "point", "m", FieldPlace::list, 2);
    add(group + "normal_force", "N", FieldPlace::list, 1);
  }
  add("rose/number", "-", FieldPlace::list, 1);
  add("rose/force", "-", FieldPlace::list, 1);
  return all;
}

// Each disc touches the one to its right, and the first of them the bottom.
void add_observed(const SyntheticRun& run, double share, std::vector<std::vector<double>>& fields) {
  const double d = run.diameter, height = d * squeeze(share);
  std::vector<double> centre, chain, ids, point, force, rose(18, 0.0);
  for (int disc = 0; disc < run.rows * run.columns; ++disc) {
    centre.insert(centre.end(),
                  {d * (disc % run.columns + 0.5), height * (disc / run.columns + 0.5)});
    chain.push_back(disc / run.columns);
    if ((disc + 1) % run.columns == 0) continue;
    ids.insert(ids.end(), {1.0 * disc, disc + 1.0});
    point.insert(point.end(), {d * (disc % run.columns + 1), height * (disc / run.columns + 0.5)});
    force.push_back(100.0 * share * (1 + disc % 3));
  }
  rose[0] = 1;
  const double nan = std::numeric_limits<double>::quiet_NaN(), density = 0.785 / squeeze(share);
  fields.insert(fields.end(), {centre,
                               chain,
                               {density, nan, 1.01 * density, nan},
                               {density, 1.01 * density},
                               {0, d * run.columns / 2, d * run.columns},
                               {0, height * run.rows / 2, height * run.rows},
                               ids,
                               point,
                               force,
                               {0, 1},
                               {d / 2, 0},
                               {50 * share},
                               rose,
                               rose});
}

// How many columns of discs have come off: one with every frame.
int loose_columns(const SyntheticRun& run, double share) {
  return std::min(run.columns - 1, static_cast<int>(share * run.columns));
}

// Columns are bonded by a vertical line each, and to nothing once it is broken.
void add_bonds(const SyntheticRun& run, double share, std::vector<std::vector<double>>& fields) {
  const int loose = loose_columns(run, share);
  const double d = run.diameter, top = d * run.rows * squeeze(share);
  std::vector<double> start[2], end[2], length, number, area, of_particle, damage;  // bonds, cracks
  for (int line = 1; line < run.columns; ++line) {
    const bool is_crack = line <= loose;
    start[is_crack].insert(start[is_crack].end(), {d * line, 0});
    end[is_crack].insert(end[is_crack].end(), {d * line, top});
    if (!is_crack) length.push_back(top);
  }
  for (int fragment = 0; fragment <= loose; ++fragment) {
    number.push_back(fragment);
    area.push_back(d * d * run.rows * (fragment < loose ? 1 : run.columns - loose));
  }
  for (int disc = 0; disc < run.rows * run.columns; ++disc) {
    of_particle.push_back(std::min(disc % run.columns, loose));
    damage.push_back(disc % run.columns < loose ? 1 : 0);
  }
  fields.insert(fields.end(),
                {start[0], end[0], start[1], end[1], length, number, area, of_particle, damage});
}

std::vector<TableInfo> tables(const SyntheticRun& run) {
  if (!run.bonds) return {};
  std::vector<SeriesInfo> columns;
  for (const char* name : {"time", "length", "shear", "energy"})
    columns.push_back({name, "SI", "", "made up"});
  return {{"cracks", columns}};
}

std::vector<std::vector<double>> frame_of(const SyntheticRun& run, double share) {
  const auto xy = positions(run, share);
  const auto stress = stresses(run, share);
  std::vector<double> strain, tensor;
  for (const double value : stress) {
    strain.push_back(0.3 * share * value / yield);
    tensor.insert(tensor.end(), {-0.4 * value, -value, -0.5 * value, 0.1 * value});
  }
  std::vector<std::vector<double>> fields{xy, std::vector<double>(xy.size(), 0.5), stress, strain,
                                          tensor};
  const double d = run.diameter;
  if (run.cell) fields.push_back({d, 0, d * run.columns, 0, 0, d * run.rows * squeeze(share)});
  if (run.bonds) add_bonds(run, share, fields);
  if (run.tools) fields.push_back(tool_corners(run, share));
  if (run.observed) add_observed(run, share, fields);
  return fields;
}

std::vector<SeriesInfo> series(bool tools, bool bonds) {
  std::vector<SeriesInfo> all = {
      {"energy/kinetic", "J", "kinetic energy $E$", "kinetic energy"},
      {"energy/elastic", "J", "elastic energy $E$", "elastic energy"},
      {"energy/plastic", "J", "plastic energy $E$", "plastic work"},
      {"energy/hourglass", "J", "hourglass energy $E$", "energy of hourglass modes"},
      {"energy/balance", "J", "energy balance error $E$", "energy made or lost"},
      {"contacts", "-", "boundary edges in contact", "edges in contact"}};
  if (bonds)
    for (const auto& [name, unit] : {std::pair("energy/bonds", "J"),
                                     {"energy/fracture", "J"},
                                     {"bonds/crack_length", "m"},
                                     {"bonds/fragments", "-"},
                                     {"bonds/damage", "-"},
                                     {"bonds/largest_fragment", "-"}})
      all.push_back({name, unit, "", "made up"});
  if (!tools) return all;
  for (const std::string tool : {"top", "bottom"}) {
    all.push_back({"tool/" + tool + "/position_x", "m", "position of " + tool + " $x$",
                   "position of the tool"});
    all.push_back({"tool/" + tool + "/position_y", "m", "position of " + tool + " $y$",
                   "position of the tool"});
    all.push_back(
        {"tool/" + tool + "/force_x", "N", "force on " + tool + " $F_x$", "force on the tool"});
    all.push_back(
        {"tool/" + tool + "/force_y", "N", "force on " + tool + " $F_y$", "force on the tool"});
  }
  all.push_back({"relative_density", "-", "relative density $\\rho$", "solid share of the die"});
  all.push_back({"stress_ratio/axial", "-",
                 "axial stress over yield stress $\\sigma_\\mathrm{ax}/\\sigma_y$",
                 "axial stress over the yield stress"});
  all.push_back({"stress_ratio/lateral", "-",
                 "lateral stress over yield stress $\\sigma_\\mathrm{lat}/\\sigma_y$",
                 "lateral stress over the yield stress"});
  return all;
}

// The punch comes down to share 1 at 0.9 of the time and lifts a little: the density turns back.
double share_at(double time) {
  const double t = time / duration;
  return t < 0.9 ? t / 0.9 : 1 - 0.3 * (t - 0.9);
}

std::vector<double> row(const SyntheticRun& run, double time) {
  const double share = share_at(time), ratio = 3 * share * share * share + 0.3 * share;
  const double load = time > 0.9 * duration ? 1 - 8 * (1 - share) : 1;
  const double force = std::max(0.0, load) * ratio * yield * run.columns * run.diameter * 1e-3;
  const double height = run.rows * run.diameter * squeeze(share), work = 0.3 * force * 1e-3;
  std::vector<double> values = {0.004 * work * (1 + std::sin(40 * share)),
                                0.2 * work,
                                0.75 * work,
                                0.012 * work,
                                0.002 * work,
                                std::floor(400 * share)};
  if (run.bonds) {
    const int loose = loose_columns(run, share);
    const double broken = loose * run.rows * run.diameter, left = 1 - 1.0 * loose / run.columns;
    values.insert(values.end(), {0.01 * work, 20e-3 * broken, broken, loose + 1.0, 1 - left, left});
  }
  if (!run.tools) return values;
  values.insert(values.end(), {0, height, 0.001 * force, force});
  values.insert(values.end(), {0, 0, -0.001 * force, -0.93 * force});
  values.insert(values.end(), {0.785 / squeeze(share), std::max(0.0, load) * ratio,
                               0.55 * ratio * (0.3 + 0.7 * std::max(0.0, load))});
  return values;
}

void write_summary(const SyntheticRun& run, const std::filesystem::path& folder) {
  const int cells = run.rows * run.columns * run.divisions * run.divisions;
  nlohmann::ordered_json summary = {{"title", "A synthetic compact </script><b>& more</b>"},
                                    {"outcome", "done"},
                                    {"steps", 94000},
                                    {"elements", cells},
                                    {"wall_seconds", 18.34},
                                    {"threads", 2},
                                    {"element_updates_per_second", 98.2e6},
                                    {"peak_memory_bytes", 61e6},
                                    {"thickness", 1e-3},
                                    {"energy_balance_error", 0.0021},
                                    {"materials",
                                     {{{"name", "steel"},
                                       {"density", 7960},
                                       {"youngs_modulus", 193e9},
                                       {"poissons_ratio", 0.3},
                                       {"yield_stress", 290e6}}}}};
  if (run.tools) {
    const double top = run.rows * run.diameter * squeeze(share_at(duration));
    const double right = run.columns * run.diameter;
    summary["relative_density"] = 0.962;
    summary["limits"] = {{"energy_balance", 0.05}, {"kinetic_energy", 0.05}};
    summary["quality"] = {{{"name", "Energy balance error"}, {"value", 0.0021}, {"limit", 0.05}},
                          {{"name", "Hourglass energy"},
                           {"meaning", "made up"},
                           {"value", 0.16},
                           {"limit", 0.03},
                           {"line", "hourglass energy 16% (limit 3%): take more elements"},
                           {"advice", "take more elements"}}};
    summary["tools"] = {{{"name", "top"}, {"point", {0.0, top}}, {"normal", {0, -1}}},
                        {{"name", "bottom"}, {"point", {0.0, 0.0}}, {"normal", {0, 1}}},
                        {{"name", "left"}, {"point", {0.0, 0.0}}, {"normal", {1, 0}}},
                        {{"name", "right"}, {"point", {right, 0.0}}, {"normal", {-1, 0}}}};
  }
  write_own(folder / "summary.json", role::run, summary.dump(2) + "\n");
}

}  // namespace

void record(const SyntheticRun& run, const std::filesystem::path& folder) {
  open_run_folder(folder, true);
  Recorder recorder(folder, {"0.1.0", "0123abc", "A synthetic compact", "f00d", 7, 2}, mesh_of(run),
                    series(run.tools, run.bonds), fields(run), simulated_time, tables(run));
  const int samples = (run.frames - 1) * run.samples_a_frame;
  for (int i = 0; i <= samples; ++i) {
    const double time = duration * i / std::max(1, samples);
    recorder.sample(time, row(run, time));
    if (run.bonds)
      while (recorder.rows(0) < loose_columns(run, share_at(time)))
        recorder.row(0, std::vector{time, run.rows * run.diameter,
                                    static_cast<double>(recorder.rows(0)) / run.columns, 1e-5});
    if (run.pictures && i % run.samples_a_frame == 0)
      recorder.frame(time, 94 * i, frame_of(run, share_at(time)));
  }
  recorder.finish();
  write_summary(run, folder);
}

}  // namespace pulvis::testing
