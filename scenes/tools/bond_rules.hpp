// The laws of bonds that a scene asks for, pair by pair.
#pragma once

#include "components/bond.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Whether anything can be bonded: adhesion is no bond.
bool has_bonds(const Scene& scene);

// Without what follows from the meshes: see bounded_by.
BondRules bond_rules(const Scene& scene);

// The same with bounds on what Weibull's law draws. Throws SceneError where a fracture energy is less than what the
// bond's spring stores on the softest edges.
BondRules bounded_by(const Bodies& bodies, const Scene& scene, BondRules rules);

// -, stiffness over the contact spring's of the stiffest bond that a material can have, made at the start or by pressure;
// 0: none.
double stiffest_bond(const BondRules& rules, int material, bool pressed);

// m, gap across which a bond can hold: what was bonded at the start, and the opening at which it is broken in its longest
// mode.
double longest_gap(const Bodies& bodies, const BondRules& rules);

}  // namespace pulvis
