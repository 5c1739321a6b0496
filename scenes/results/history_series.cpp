#include "scenes/results/history_series.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "scenes/results/bond_results.hpp"
#include "scenes/results/observed_results.hpp"
#include "scenes/results/shear_results.hpp"
#include "scenes/space/results/observed_density.hpp"
#include "scenes/space/results/observed_network.hpp"
#include "scenes/space/results/observed_stress.hpp"
#include "scenes/space/results/space_series.hpp"
#include "scenes/tools/bond_rules.hpp"
#include "scenes/tools/cell.hpp"
#include "scenes/tools/die_cell.hpp"

namespace pulvis {
namespace {

bool is_driven_through_a_spring(const Scene& scene, const ToolSpec& tool) {
  return std::ranges::any_of(scene.stages, [&](const StageSpec& stage) {
    return std::ranges::any_of(stage.moves, [&](const MoveSpec& move) {
      return move.stiffness && &scene.tools[static_cast<std::size_t>(move.tool)] == &tool;
    });
  });
}

bool is_servo_driven(const Scene& scene, const ToolSpec& tool) {
  return std::ranges::any_of(scene.stages, [&](const StageSpec& stage) {
    return std::ranges::any_of(stage.servos, [&](const ServoSpec& servo) {
      return &scene.tools[static_cast<std::size_t>(servo.tool)] == &tool;
    });
  });
}

// Series with their descriptions, in the order of the history's columns.
class SeriesList {
 public:
  explicit SeriesList(const Scene& scene) : scene_(scene) {}

  void add_tool(const ToolSpec& tool) {
    const std::string name = "tool/" + tool.name + "/";
    const bool constraint = tool.shape == ToolSpec::Shape::constraint;
    const bool radial = constraint && tool.holds == ToolSpec::Holds::radial;
    const char* middle = radial
                             ? "x: position of its centre plus the radial displacement of its nodes"
                         : tool.radius ? "of the centre of its circle, which moves with its nodes"
                         : constraint  ? "of the centre of its box, which moves with its nodes"
                                       : "of a point on the tool's surface";
    add(name + "position_x", "m", middle);
    add(name + "position_y", "m", middle);
    add(name + "force_x", "N",
        radial ? "radial force of the particles on the tool"
               : "force of the particles on the tool");
    add(name + "force_y", "N", "force of the particles on the tool");
    if (is_servo_driven(scene_, tool))
      add(name + "force_asked", "N",
          "force that its servo is to hold at this time, in the direction it pushes");
    else if (is_driven_through_a_spring(scene_, tool))
      add(name + "drive_force", "N",
          "force of its drive's spring and dashpot on it, along its move");
  }

  void add_die() {
    add("relative_density", "-", "undeformed particle area / area between the tools");
    if (common_yield_stress(scene_)) {
      add("stress_ratio/axial", "-", "mean of top and bottom stress / yield stress");
      add("stress_ratio/lateral", "-", "mean of left and right stress / yield stress");
    }
    add("stress/axial_top", "Pa",
        "on the top tool: force / width of the die times thickness; compression > 0");
    add("stress/axial_bottom", "Pa", "on the bottom tool, defined likewise");
    add("stress/radial_left", "Pa",
        "on the left tool: force / height between the punches times thickness");
    add("stress/radial_right", "Pa", "on the right tool, defined likewise");
    add("stress/transmission", "-",
        "axial force on the bottom tool / on the top tool; NaN where the top carries none");
  }

  void add_cell() {
    if (scene_.cell) add("relative_density", "-", "undeformed particle area / area of the cell");
    add("cell/width", "m", "length of its first vector, or between the walls");
    add("cell/height", "m", "length of its second vector, or between the walls");
    for (const char* part : {"xx", "yy", "xy"})
      add(std::string("cell/strain_") + part, "-",
          "logarithmic: rate of deformation of the cell, integrated");
    add("cell/rotation", "rad", "spin of the cell, integrated");
    for (const char* part : {"xx", "yy", "xy"})
      add(std::string("cell/stress_") + part, "Pa",
          "Cauchy, of the contact forces in the cell, or of the forces on the walls; tension > 0");
    add("cell/stored_energy", "J/m^3",
        "in elements including their hourglass modes, contact springs and bonds, per current "
        "volume of the cell");
    add("cell/dissipated_energy", "J/m^3",
        "by plastic flow, friction, damping and fracture so far, per the same volume");
  }

  void add_energies() {
    add("energy/kinetic", "J", "of all nodes");
    add("energy/elastic", "J", "stored in the elements");
    add("energy/plastic", "J", "dissipated by plastic flow");
    add("energy/hourglass", "J", "stored and dissipated in hourglass modes; zero with four points");
    add("energy/contact", "J", "stored in the contact springs");
    add("energy/friction", "J", "dissipated by friction");
    add("energy/damping", "J", "dissipated by contact damping");
    if (std::ranges::any_of(scene_.materials, &MaterialSpec::damped))
      add("energy/bulk_damping", "J", "dissipated by material damping");
    if (has_bonds(scene_)) {
      add("energy/bonds", "J", "stored in the bonds");
      add("energy/fracture", "J", "dissipated in breaking bonds");
    }
    add("energy/external", "J", scene_.cell ? "work of the cell" : "work of the tools");
    add("energy/balance", "J",
        "sum of all energies minus the external work and the initial energy");
  }

  void add_contacts() {
    add("contacts", "-", "boundary edges in contact with another particle or a tool");
    add("penetration", "-", "deepest so far, relative to the boundary edge length");
    add("contact_overlap", "-", "area in which outlines overlap / area of the particles");
    add("narrow_contacts", "-",
        "share of the contact force carried by contacts narrower than two boundary edges");
    add(bond_series(scene_));
  }

  void add_quality() {
    add("min_jacobian", "-", "smallest det F so far");
    add("dt", "s", "time step");
  }

  void add(const std::vector<SeriesInfo>& others) {
    series_.insert(series_.end(), others.begin(), others.end());
  }

  std::vector<SeriesInfo> taken() { return std::move(series_); }

 private:
  void add(const std::string& name, const char* unit, const char* meaning) {
    series_.push_back({name, unit, meaning});
  }

  const Scene& scene_;
  std::vector<SeriesInfo> series_;
};

}  // namespace

namespace {

// Energies and quality measures as in two dimensions; tools and contacts have their own names.
std::vector<SeriesInfo> history_in_space(const Scene& scene) {
  SeriesList list(scene);
  list.add(space::tool_series(scene));
  list.add_energies();
  list.add(space::contact_series());
  list.add(bond_series(scene));
  list.add_quality();
  list.add(space::stress_series(scene));
  list.add(space::network_series(scene));
  list.add(space::density_series(scene));
  return list.taken();
}

}  // namespace

std::vector<SeriesInfo> history_series(const Scene& scene) {
  if (scene.space) return history_in_space(scene);
  SeriesList list(scene);
  for (const ToolSpec& tool : scene.tools) list.add_tool(tool);
  if (die_cell(scene)) list.add_die();
  if (scene.cell || drives_walls(scene)) list.add_cell();
  list.add_energies();
  list.add_contacts();
  list.add_quality();
  list.add(observed_series(scene));
  list.add(ShearResults::series(scene));
  return list.taken();
}

std::vector<SeriesInfo> momentum_series(const Scene& scene) {
  if (scene.space) return space::momentum_series();
  return {{"momentum/x", "kg m/s", "of all nodes"},
          {"momentum/y", "kg m/s", "of all nodes"},
          {"momentum/angular", "kg m^2/s", "of all nodes, about the origin"}};
}

}  // namespace pulvis
