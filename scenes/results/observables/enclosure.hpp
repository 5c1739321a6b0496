// The space to which densities and mean stresses of the powder refer: the periodic cell, or what the tools enclose.
#pragma once

#include <functional>

#include "components/die_room.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/tools/die_cell.hpp"

namespace pulvis {

// m^2, in three dimensions m^3, now; NaN where the tools do not enclose it. An empty function: the scene has none.
std::function<double(const World&)> enclosure_of(const Scene& scene);

double area_of(const World& world, const DieCell& die);    // m^2
double volume_of(const World& world, const DieRoom& die);  // m^3
Vec2 size_of(const World& world, const DieCell& die);      // m, width and height

// m and N, of a tool along an axis.
double tool_position(const World& world, int tool, int axis);
double tool_force(const World& world, int tool, int axis);

}  // namespace pulvis
