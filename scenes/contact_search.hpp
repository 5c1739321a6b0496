// How far contacts look, and what is counted of bonds: both dimensions.
#pragma once

#include "components/run_state.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Where the scene has bonds.
void add_bond_totals(World& world, const Scene& scene);

// `bonds`: m, gap across which they act; 0 without them.
void set_reach(ContactIndex& index, const Scene& scene, const ContactRules& rules, double bonds);

}  // namespace pulvis
