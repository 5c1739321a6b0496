#include "tests/helpers/synthetic_space_run.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "engine/files/own_files.hpp"
#include "engine/files/recorder.hpp"
#include "engine/files/run_folder.hpp"
#include "tests/helpers/synthetic_space_bonds.hpp"

namespace pulvis::testing {
namespace {

using Vec3 = Eigen::Vector3d;
using Cube = std::array<int, 3>;

constexpr double space_duration = 1e-3, space_yield = 290e6;
constexpr int die_sides = 24;

double space_squeeze(double share) { return 1 - 0.25 * share; }

// One sphere of diameter 2: a cube and rings around it.
struct Ball {
  std::vector<Vec3> nodes;
  std::vector<std::int32_t> hexahedra;
};

// Of the points of an n x n x n cube, those of its surface; four of them a square, counter-clockwise from outside.
struct CubeSurface {
  std::vector<Cube> points;
  std::vector<std::array<std::int32_t, 4>> squares;
};

CubeSurface surface_of(int n) {
  CubeSurface surface;
  std::map<Cube, std::int32_t> number;
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end)
      for (int i = 0; i < n * n; ++i) {
        std::array<std::int32_t, 4> square{};
        for (int corner = 0; corner < 4; ++corner) {
          const int du = corner == 1 || corner == 2, dv = corner > 1;
          Cube at{};
          at[static_cast<std::size_t>(axis)] = end * n;
          at[static_cast<std::size_t>((axis + 1) % 3)] = i % n + (end == 1 ? du : dv);
          at[static_cast<std::size_t>((axis + 2) % 3)] = i / n + (end == 1 ? dv : du);
          const auto [found, is_new] =
              number.try_emplace(at, static_cast<std::int32_t>(surface.points.size()));
          if (is_new) surface.points.push_back(at);
          square[static_cast<std::size_t>(corner)] = found->second;
        }
        surface.squares.push_back(square);
      }
  return surface;
}

Vec3 on_cube(const Cube& at, int n) {
  return {2.0 * at[0] / n - 1, 2.0 * at[1] / n - 1, 2.0 * at[2] / n - 1};
}

void add_core(Ball& ball, int n, double half) {
  const int side = n + 1;
  for (int i = 0; i < side * side * side; ++i)
    ball.nodes.push_back(half * on_cube({i % side, i / side % side, i / side / side}, n));
  for (int i = 0; i < n * n * n; ++i) {
    const int first = i % n + side * (i / n % n) + side * side * (i / n / n);
    for (const int above : {0, side * side})
      for (const int to : {0, 1, side + 1, side}) ball.hexahedra.push_back(first + above + to);
  }
}

Ball ball_of(const SyntheticSpaceRun& run) {
  Ball ball;
  const int n = run.divisions, side = n + 1;
  constexpr double half = 0.42;  // of the core's edge
  add_core(ball, n, half);
  const CubeSurface surface = surface_of(n);
  const auto node = [&](int ring, std::int32_t point) {
    const Cube& at = surface.points[static_cast<std::size_t>(point)];
    return ring == 0
               ? at[0] + side * at[1] + side * side * at[2]
               : static_cast<int>(side * side * side +
                                  (ring - 1) * static_cast<int>(surface.points.size()) + point);
  };
  for (int ring = 1; ring <= run.rings; ++ring) {
    const double out = static_cast<double>(ring) / run.rings;
    for (const Cube& at : surface.points) {
      const Vec3 cube = on_cube(at, n);
      ball.nodes.emplace_back((1 - out) * half * cube + out * cube.normalized());
    }
    for (const auto& square : surface.squares)
      for (const int r : {ring - 1, ring})
        for (const auto corner : square) ball.hexahedra.push_back(node(r, corner));
  }
  return ball;
}

Vec3 centre_of(const SyntheticSpaceRun& run, int sphere) {
  return Vec3::Map(lattice_place(run, sphere).data());
}

// Every sphere's mesh is turned; as it is squeezed it gets flat sides.
Vec3 moved(const Vec3& in_ball, int sphere, double flat) {
  const Eigen::AngleAxisd turn(1.7 * sphere, Vec3(1, 0.3 * sphere, 0.5).normalized());
  const Vec3 at = turn * in_ball;
  const double radius = at.norm(), most = at.cwiseAbs().maxCoeff();
  return most > 0 ? Vec3(at * (1 + flat * std::min(0.25, radius / most - 1))) : at;
}

std::vector<double> space_positions(const SyntheticSpaceRun& run, const Ball& ball, double share) {
  std::vector<double> xyz;
  for (int sphere = 0; sphere < spheres(run); ++sphere)
    for (const Vec3& node : ball.nodes) {
      Vec3 at = centre_of(run, sphere) + run.diameter / 2 * moved(node, sphere, share);
      at.z() *= space_squeeze(share);
      xyz.insert(xyz.end(), at.begin(), at.end());
    }
  return xyz;
}

// Corners of a piece of the plane across `axis`, seen from the side where it grows (`up`) or falls.
void add_sheet(ToolFaces& tools, const std::string& name) {
  const auto first = static_cast<std::int32_t>(tools.points);
  tools.corners.insert(tools.corners.end(), {first, first + 1, first + 2, first + 3});
  tools.tool.push_back(static_cast<std::int32_t>(tools.names.size()));
  tools.names.push_back(name);
  tools.kinds.emplace_back("plane");
  tools.points += 4;
}

void add_die(ToolFaces& tools) {
  for (int i = 0; i < die_sides; ++i) {
    const auto at = static_cast<std::int32_t>(tools.points), a = at + 2 * i,
               b = at + 2 * ((i + 1) % die_sides);
    tools.corners.insert(tools.corners.end(), {a, a + 1, b + 1, b});
    tools.tool.push_back(static_cast<std::int32_t>(tools.names.size()));
  }
  tools.names.emplace_back("die");
  tools.kinds.emplace_back("die");
  tools.points += 2 * die_sides;
}

ToolFaces tool_faces(const SyntheticSpaceRun& run) {
  ToolFaces tools;
  for (const char* name : {"top", "bottom"}) add_sheet(tools, name);
  if (run.die) {
    add_die(tools);
    return tools;
  }
  for (const char* name : {"left", "right", "front", "back"}) add_sheet(tools, name);
  return tools;
}

std::vector<double> space_tool_corners(const SyntheticSpaceRun& run, double share) {
  const double w = run.columns * run.diameter, h = run.layers * run.diameter,
               top = h * space_squeeze(share);
  std::vector<double> xyz{0, 0, top, 0, w, top, w, w, top, w, 0, top,
                          0, 0, 0,   w, 0, 0,   w, w, 0,   0, w, 0};
  const auto add = [&](std::initializer_list<double> corners) { xyz.insert(xyz.end(), corners); };
  if (!run.die) {
    add({0, 0, 0, 0, w, 0, 0, w, h, 0, 0, h});
    add({w, 0, 0, w, 0, h, w, w, h, w, w, 0});
    add({0, 0, 0, 0, 0, h, w, 0, h, w, 0, 0});
    add({0, w, 0, w, w, 0, w, w, h, 0, w, h});
    return xyz;
  }
  for (int i = 0; i < die_sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / die_sides, r = w / std::numbers::sqrt2;
    const double x = w / 2 + r * std::cos(angle), y = w / 2 + r * std::sin(angle);
    add({x, y, 0, x, y, h});
  }
  return xyz;
}

std::vector<ParticleTag> tags_of(const SyntheticSpaceRun& run) {
  ParticleTag number{"number", "particle", "of the particle", {}, {}};
  ParticleTag material{"material", "material", "position in `names`", {}, {"steel", "copper"}};
  ParticleTag of_class{"class", "class", "position in `names`", {}, {"ball"}};
  for (int sphere = 0; sphere < spheres(run); ++sphere) {
    number.values.push_back(sphere);
    material.values.push_back((sphere % run.columns + sphere / run.columns) % 2);
    of_class.values.push_back(0);
  }
  return {number, material, of_class};
}

RunMesh space_mesh_of(const SyntheticSpaceRun& run, const Ball& ball) {
  RunMesh mesh;
  const auto nodes = static_cast<std::int32_t>(ball.nodes.size());
  for (int sphere = 0; sphere < spheres(run); ++sphere) {
    mesh.node_particle.insert(mesh.node_particle.end(), ball.nodes.size(), sphere);
    mesh.cell_particle.insert(mesh.cell_particle.end(), ball.hexahedra.size() / 8, sphere);
    for (const auto node : ball.hexahedra) mesh.hexahedra.push_back(sphere * nodes + node);
  }
  mesh.reference = space_positions(run, ball, 0);
  mesh.tags = tags_of(run);
  if (run.tools) mesh.tool_faces = tool_faces(run);
  return mesh;
}

// High towards the flat sides, with a little of each sphere's own.
std::vector<double> space_stresses(const SyntheticSpaceRun& run, const Ball& ball, double share) {
  std::vector<double> values;
  for (int sphere = 0; sphere < spheres(run); ++sphere)
    for (std::size_t cell = 0; cell < ball.hexahedra.size() / 8; ++cell) {
      Vec3 middle = Vec3::Zero();
      for (std::size_t k = 0; k < 8; ++k)
        middle += ball.nodes[static_cast<std::size_t>(ball.hexahedra[8 * cell + k])] / 8;
      const double reach = 0.35 + 0.65 * moved(middle, sphere, 0).cwiseAbs().maxCoeff();
      values.push_back(space_yield * share *
                       std::min(1.2, reach * (1.1 + 0.15 * std::sin(3.7 * sphere))));
    }
  return values;
}

std::vector<FieldInfo> space_fields(const SyntheticSpaceRun& run) {
  std::vector<FieldInfo> all{
      {"position", "m", "position $x$", "position of the node", FieldPlace::node, 3},
      {"effective_stress", "Pa", "effective stress $\\sigma_\\mathrm{eff}$", "von Mises stress",
       FieldPlace::cell, 1},
      {"pressure", "Pa", "pressure $p$", "made up", FieldPlace::cell, 1},
      {"plastic_strain", "-", "plastic strain $\\bar\\varepsilon_p$", "accumulated plastic strain",
       FieldPlace::cell, 1},
      {"coordination", "-", "coordination number $Z$", "made up", FieldPlace::particle, 1, true}};
  if (run.densities) {
    all.push_back(
        {"local_density", "-", "local relative density $\\rho$", "made up", FieldPlace::list, 3});
    for (const std::string axis : {"x", "y", "z"})
      all.push_back({"density_grid/" + axis, "m", "", "made up", FieldPlace::list, 1});
  }
  if (run.contacts) {
    all.push_back(
        {"particle_centre", "m", "centre of the particle $x$", "made up", FieldPlace::particle, 3});
    for (const std::string group : {"contacts/", "tool_contacts/"}) {
      all.push_back({group + "ids", "-", "", "made up", FieldPlace::list, 2, true});
      all.push_back({group + "point", "m", "", "made up", FieldPlace::list, 3});
      all.push_back({group + "normal_force", "N", "", "made up", FieldPlace::list, 1});
    }
  }
  append_bond_fields_in_space(run, all);
  if (run.tools)
    all.push_back(
        {"tools/outline", "m", "outlines of the tools $x$", "made up", FieldPlace::list, 3});
  return all;
}

// Densest at the top; no room in the first cell.
void append_grid_in_space(const SyntheticSpaceRun& run, double share,
                          std::vector<std::vector<double>>& values) {
  const std::array<int, 3> count{3, 2, 4};
  std::vector<double> cells;
  for (int c = 0; c < 24; ++c)
    cells.push_back(0.5 + 0.1 * share + 0.02 * (c / 6) + 0.01 * (c % 3) + 0.005 * (c / 3 % 2));
  cells[0] = std::numeric_limits<double>::quiet_NaN();
  values.push_back(cells);
  for (std::size_t k = 0; k < 3; ++k) {
    const double wide = run.diameter * (k < 2 ? run.columns : run.layers * space_squeeze(share));
    std::vector<double> lines;
    for (int i = 0; i <= count[k]; ++i) lines.push_back(wide * i / count[k]);
    values.push_back(lines);
  }
}

// Where a contact stands, between which, and its force.
struct SpaceContacts {
  std::vector<double> ids, point, force;
  void add(int first, int second, const Vec3& at, double size) {
    ids.insert(ids.end(), {static_cast<double>(first), static_cast<double>(second)});
    point.insert(point.end(), {at.x(), at.y(), at.z()});
    force.push_back(size);
  }
};

// Neighbours along the axes of the lattice; the top punch is tool 0, the bottom one 1.
void append_contacts_in_space(const SyntheticSpaceRun& run, double share,
                              std::vector<std::vector<double>>& values) {
  const int c = run.columns, layer = c * c;
  const double half = 0.5 * run.diameter;
  const auto centre = [&](int sphere) {
    Vec3 at = centre_of(run, sphere);
    at.z() *= space_squeeze(share);
    return at;
  };
  SpaceContacts pairs, tools;
  std::vector<double> centres;
  for (int sphere = 0; sphere < spheres(run); ++sphere) {
    const Vec3 at = centre(sphere);
    const double size = 100 * share * (1 + sphere % 3);
    centres.insert(centres.end(), {at.x(), at.y(), at.z()});
    if (sphere % c + 1 < c) pairs.add(sphere, sphere + 1, at + half * Vec3::UnitX(), size);
    if (sphere / c % c + 1 < c) pairs.add(sphere, sphere + c, at + half * Vec3::UnitY(), size);
    if (sphere + layer < spheres(run))
      pairs.add(sphere, sphere + layer, 0.5 * (at + centre(sphere + layer)), 3 * size);
    if (sphere + layer >= spheres(run)) tools.add(sphere, 0, at + half * Vec3::UnitZ(), 3 * size);
    if (sphere < layer) tools.add(sphere, 1, at - half * Vec3::UnitZ(), 3 * size);
  }
  values.push_back(centres);
  for (const SpaceContacts& of : {pairs, tools})
    values.insert(values.end(), {of.ids, of.point, of.force});
}

std::vector<std::vector<double>> space_frame_of(const SyntheticSpaceRun& run, const Ball& ball,
                                                double share) {
  const auto stress = space_stresses(run, ball, share);
  std::vector<double> pressure, strain, coordination;
  for (const double value : stress) {
    pressure.push_back(1.5 * value);
    strain.push_back(0.3 * share * value / space_yield);
  }
  for (int sphere = 0; sphere < spheres(run); ++sphere) coordination.push_back(3 + sphere % 4);
  std::vector<std::vector<double>> values{space_positions(run, ball, share), stress, pressure,
                                          strain, coordination};
  if (run.densities) append_grid_in_space(run, share, values);
  if (run.contacts) append_contacts_in_space(run, share, values);
  append_bonds_in_space(run, share, space_squeeze(share), values);
  if (run.tools) values.push_back(space_tool_corners(run, share));
  return values;
}

std::vector<SeriesInfo> space_series(const SyntheticSpaceRun& run) {
  std::vector<SeriesInfo> all = {{"energy/kinetic", "J", "kinetic energy $E$", "kinetic energy"},
                                 {"energy/elastic", "J", "elastic energy $E$", "elastic energy"},
                                 {"energy/plastic", "J", "plastic energy $E$", "plastic work"}};
  append_bond_series_in_space(run, all);
  if (!run.tools) return all;
  for (const std::string tool : {"top", "bottom"})
    for (const std::string axis : {"x", "y", "z"}) {
      all.push_back({"tool/" + tool + "/position_" + axis, "m",
                     "position of " + tool + " $" + axis + "$", "position of the tool"});
      all.push_back({"tool/" + tool + "/force_" + axis, "N",
                     "force on " + tool + " $F_" + axis + "$", "force on the tool"});
    }
  all.push_back({"relative_density", "-", "relative density $\\rho$", "solid share of the room"});
  return all;
}

std::vector<double> space_row(const SyntheticSpaceRun& run, double share) {
  const double area = std::pow(run.columns * run.diameter, 2);
  const double force = space_yield * area * share * share * 3, work = 0.3 * force * run.diameter;
  std::vector<double> values{0.004 * work, 0.2 * work, 0.75 * work};
  append_bond_row_in_space(run, share, values);
  if (!run.tools) return values;
  const double top = run.layers * run.diameter * space_squeeze(share);
  values.insert(values.end(), {0, 0.001 * force, 0, 0.002 * force, top, force});
  values.insert(values.end(), {0, -0.001 * force, 0, -0.002 * force, 0, -0.95 * force});
  values.push_back(0.52 / space_squeeze(share));
  return values;
}

void space_write_summary(const SyntheticSpaceRun& run, const std::filesystem::path& folder) {
  nlohmann::ordered_json summary = {{"title", "Synthetic spheres"},
                                    {"outcome", "done"},
                                    {"steps", 94000},
                                    {"elements", spheres(run) * elements_of_sphere(run)},
                                    {"wall_seconds", 18.34},
                                    {"relative_density", 0.93}};
  if (run.bonds) summary["bonds"] = bond_summary_in_space(run);
  write_own(folder / "summary.json", role::run, summary.dump(2) + "\n");
}

}  // namespace

int elements_of_sphere(const SyntheticSpaceRun& run) {
  const int n = run.divisions;
  return n * n * n + 6 * n * n * run.rings;
}

void record_in_space(const SyntheticSpaceRun& run, const std::filesystem::path& folder) {
  open_run_folder(folder, true);
  const Ball ball = ball_of(run);
  Recorder recorder(folder, {"0.1.0", "0123abc", "Synthetic spheres", "f00d", 7, 2},
                    space_mesh_of(run, ball), space_series(run), space_fields(run), simulated_time,
                    bond_tables_in_space(run));
  const int samples = (run.frames - 1) * run.samples_a_frame;
  for (int i = 0; i <= samples; ++i) {
    const double share = static_cast<double>(i) / std::max(1, samples);
    recorder.sample(space_duration * share, space_row(run, share));
    record_cracks_in_space(run, share, space_duration * share, recorder);
    if (i % run.samples_a_frame == 0)
      recorder.frame(space_duration * share, 94 * i, space_frame_of(run, ball, share));
  }
  recorder.finish();
  space_write_summary(run, folder);
}

}  // namespace pulvis::testing
