#include "scenes/results/observables/enclosure.hpp"

#include <limits>

#include "components/contact.hpp"
#include "scenes/tools/cell.hpp"
#include "scenes/tools/die_relief.hpp"
#include "scenes/tools/die_room.hpp"
#include "systems/tools/relief_kernel.hpp"

namespace pulvis {
namespace {

// Whether both other tools are in the die: nothing encloses the powder beyond its mouth.
bool encloses(const World& world, const DieRoom& die) {
  if (!die.mouth) return true;
  const auto above_die = [&](DieRoom::Side side) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = static_cast<int>(k);
      sum += die.axis[k] *
             (tool_position(world, die.tool[side], axis) - tool_position(world, die.die, axis));
    }
    return sum;
  };
  return above_die(DieRoom::bottom) < *die.mouth && above_die(DieRoom::top) <= *die.mouth;
}

}  // namespace

double tool_position(const World& world, int tool, int axis) {
  return world.column<ToolPosition>().values()[tool_axes * tool + axis];
}

double tool_force(const World& world, int tool, int axis) {
  return world.column<ToolForce>().values()[tool_axes * tool + axis];
}

double area_of(const World& world, const DieCell& die) {
  const auto at = [&](int tool, int axis) { return tool_position(world, tool, axis); };
  return kernels::die_area(
      {at(die.left, 0), at(die.right, 0), at(die.top, 1), at(die.bottom, 0), at(die.bottom, 1)},
      relief_of(world, die.bottom));
}

double volume_of(const World& world, const DieRoom& die) {
  if (!encloses(world, die)) return std::numeric_limits<double>::quiet_NaN();
  return die.volume([&](int tool, int axis) { return tool_position(world, tool, axis); });
}

Vec2 size_of(const World& world, const DieCell& die) {
  const auto at = [&](int tool, int axis) { return tool_position(world, tool, axis); };
  return {at(die.right, 0) - at(die.left, 0), at(die.top, 1) - at(die.bottom, 1)};
}

std::function<double(const World&)> enclosure_of(const Scene& scene) {
  if (scene.cell)
    return [](const World& world) {
      double size = 0;
      with_cell_of(world, [&](const auto& cell) { size = cell.size(); });
      return size;
    };
  if (scene.in_space()) {
    if (const auto room = die_room(scene))
      return [room = *room](const World& world) { return volume_of(world, room); };
  } else if (const auto cell = die_cell(scene)) {
    return [cell = *cell](const World& world) { return area_of(world, cell); };
  }
  return {};
}

}  // namespace pulvis
