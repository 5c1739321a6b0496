// The part of a world that a rank holds from the start.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "components/shape.hpp"
#include "engine/ranks/ranks.hpp"
#include "engine/world.hpp"

namespace pulvis {

// All of a scene, the share of one of several ranks, or a world with room for all and nothing in it.
struct Part {
  Ranks* ranks = nullptr;
  bool empty = false;
};

std::unique_ptr<World> empty_world(const Part& part);

// For ranks: divides the chunks among them, and links the world with the others. `centre`: m, [slots], of slots with
// a particle; `cost`: [chunks], in any unit.
void hold_part(World& world, const Part& part, Bodies& bodies,
               const std::vector<std::array<double, 3>>& centre, const std::vector<double>& cost);

}  // namespace pulvis
