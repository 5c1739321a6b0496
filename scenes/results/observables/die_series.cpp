// Relative density in a die and stresses on its tools.
#include <array>
#include <limits>
#include <numeric>
#include <span>

#include "components/shape.hpp"
#include "scenes/results/observables/enclosure.hpp"
#include "scenes/results/observables/result_rows.hpp"
#include "scenes/results/solids/die_wall.hpp"
#include "scenes/spec/yield.hpp"
#include "scenes/tools/die_room.hpp"

namespace pulvis {
namespace {

// Stresses in Pa, compression > 0.
struct DieFigures {
  double density = 0, top = 0, bottom = 0, transmission = 0;
  std::array<double, 4> walls{};         // left, right, front, back; or of a round die
  double axial_mean = 0, wall_mean = 0;  // of both punches, of all walls
};

double transmission_of(double top, double bottom) {
  return top > 0 ? bottom / top : std::numeric_limits<double>::quiet_NaN();
}

DieFigures figures_of(const Observation& now, const DieCell& die) {
  const World& world = now.world;
  const Vec2 face = size_of(world, die) * world.resource<Bodies>().thickness;
  const double top = tool_force(world, die.top, 1), bottom = -tool_force(world, die.bottom, 1);
  const double left = -tool_force(world, die.left, 0), right = tool_force(world, die.right, 0);
  DieFigures f{now.powder / area_of(world, die), top / face.x(), bottom / face.x(),
               transmission_of(top, bottom)};
  f.walls = {left / face.y(), right / face.y()};
  f.axial_mean = 0.5 * (top + bottom) / face.x();
  f.wall_mean = 0.5 * (right + left) / face.y();
  return f;
}

// N, on the tool at a side, away from the powder.
double push(const World& world, const DieRoom& die, DieRoom::Side side,
            const DieRoom::Vector& outward) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += tool_force(world, die.tool[side], static_cast<int>(k)) * outward[k];
  return sum;
}

template <class At>
std::array<double, 4> wall_stresses(const World& world, const DieRoom& die, const At& at) {
  if (die.kind == DieRoom::Kind::round) {
    const double wall = die.wall(at);
    return {wall > 0 ? space::normal_force_on_die(world, die.die, die.axis) / wall : 0};
  }
  const double height = die.height(at);
  const double across_x = die.depth(at) * height, across_y = die.width(at) * height;
  return {push(world, die, DieRoom::left, {-1, 0, 0}) / across_x,
          push(world, die, DieRoom::right, {1, 0, 0}) / across_x,
          push(world, die, DieRoom::front, {0, -1, 0}) / across_y,
          push(world, die, DieRoom::back, {0, 1, 0}) / across_y};
}

DieFigures figures_of(const Observation& now, const DieRoom& die) {
  const World& world = now.world;
  const auto at = [&](int tool, int axis) { return tool_position(world, tool, axis); };
  const DieRoom::Vector& axis = die.axis;
  const double top = push(world, die, DieRoom::top, axis), area = die.area(at);
  const double bottom = push(world, die, DieRoom::bottom, {-axis[0], -axis[1], -axis[2]});
  DieFigures f{now.powder / volume_of(world, die), top / area, bottom / area,
               transmission_of(top, bottom)};
  f.walls = wall_stresses(world, die, at);
  const auto walls =
      std::span(f.walls).first(die.kind == DieRoom::Kind::round ? 1 : f.walls.size());
  f.axial_mean = 0.5 * (top + bottom) / area;
  f.wall_mean =
      std::accumulate(walls.begin(), walls.end(), 0.0) / static_cast<double>(walls.size());
  return f;
}

// What differs between two dimensions, a box and a round die.
struct DieWords {
  const char *density, *wall_mean, *top, *wall;
  bool box = false, front_and_back = false;
};

constexpr DieWords plane_words{
    "undeformed particle area / area between the tools",
    "mean of left and right stress / yield stress",
    "on the top tool: force / width of the die times thickness; compression > 0",
    "on the left tool: force / height between the punches times thickness", true};
constexpr const char* volume_density =
    "undeformed particle volume / volume between the tools; NaN if one is beyond the mouth of the "
    "die";
constexpr const char* on_top = "on the top tool: force / cross-section of the die; compression > 0";
constexpr DieWords box_words{
    volume_density, "mean of the stresses on the four walls / yield stress",
    on_top,         "on this wall: force / area between the other tools",
    true,           true};
constexpr DieWords round_words{
    volume_density, "stress on the wall of the die / yield stress", on_top,
    "on the wall of the die: normal force / area between the other tools"};

template <class Die>
void add_die(const Die& die, const DieWords& words, std::optional<double> yield_stress,
             Observables& all) {
  const auto wall = [](std::size_t side) {
    return [side](const DieFigures& f) { return f.walls[side]; };
  };
  const double yield = yield_stress.value_or(1);
  const bool yields = yield_stress.has_value(), box = words.box, in_space = words.front_and_back;
  all.add(
      [die](const Observation& now) { return figures_of(now, die); },
      {{"relative_density", "-", "relative density $\\rho$", words.density, &DieFigures::density},
       {"stress_ratio/axial", "-",
        "axial stress over yield stress $\\sigma_\\mathrm{ax}/\\sigma_y$",
        "mean of top and bottom stress / yield stress",
        [yield](const DieFigures& f) { return f.axial_mean / yield; }, yields},
       {"stress_ratio/lateral", "-",
        "lateral stress over yield stress $\\sigma_\\mathrm{lat}/\\sigma_y$", words.wall_mean,
        [yield](const DieFigures& f) { return f.wall_mean / yield; }, yields},
       {"stress/axial_top", "Pa", "axial stress on the top tool $\\sigma_\\mathrm{ax}$", words.top,
        &DieFigures::top},
       {"stress/axial_bottom", "Pa", "axial stress on the bottom tool $\\sigma_\\mathrm{ax}$",
        "on the bottom tool, defined likewise", &DieFigures::bottom},
       {"stress/radial", "Pa", "stress on the die wall $\\sigma_\\mathrm{rad}$", words.wall,
        wall(0), !box},
       {"stress/radial_left", "Pa", "lateral stress on the left wall $\\sigma_\\mathrm{lat}$",
        words.wall, wall(0), box},
       {"stress/radial_right", "Pa", "lateral stress on the right wall $\\sigma_\\mathrm{lat}$",
        in_space ? words.wall : "on the right tool, defined likewise", wall(1), box},
       {"stress/radial_front", "Pa", "lateral stress on the front wall $\\sigma_\\mathrm{lat}$",
        words.wall, wall(2), in_space},
       {"stress/radial_back", "Pa", "lateral stress on the back wall $\\sigma_\\mathrm{lat}$",
        words.wall, wall(3), in_space},
       {"stress/transmission", "-", "transmission of the axial force",
        "axial force on the bottom tool / on the top tool; NaN where the top carries none",
        &DieFigures::transmission}});
}

}  // namespace

void add_die_series(const Scene& scene, Observables& all) {
  const auto yield = common_yield_stress(scene);
  if (!scene.in_space()) {
    if (const auto die = die_cell(scene)) add_die(*die, plane_words, yield, all);
  } else if (const auto die = die_room(scene)) {
    add_die(*die, die->kind == DieRoom::Kind::box ? box_words : round_words, yield, all);
  }
}

}  // namespace pulvis
