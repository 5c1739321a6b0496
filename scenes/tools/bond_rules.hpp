// The bond laws that a scene requests, pair by pair.
#pragma once

#include "components/bond.hpp"
#include "components/run_state.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Whether anything can be bonded: adhesion is not a bond.
bool has_bonds(const Scene& scene);

// Without the data that depend on the meshes: see bounded_by.
BondRules bond_rules(const Scene& scene);

// Of the boundary edges of a shape (1/m, length over the area behind), or of its faces (area over volume).
struct SurfaceSprings {
  double softest, mean;
};
std::vector<SurfaceSprings> surface_springs(const Bodies& bodies);  // [shapes], in two dimensions

// The same with bounds on the random values of Weibull's law. Throws SceneError where a fracture energy is less than the
// energy stored in the bond's spring on the softest edges or faces.
BondRules bounded_by(const Bodies& bodies, const std::vector<SurfaceSprings>& of_shape,
                     const Scene& scene, BondRules rules);

// -, stiffness of the stiffest bond that a material can have, over the contact spring's; bonds made at the start or by
// pressure; 0: none.
double stiffest_bond(const BondRules& rules, int material, bool pressed);
// For all materials.
void set_stiffest_bonds(const BondRules& bonds, ContactRules& rules);

// m, gap across which a bond can act: that of bonds at the start, plus the opening at which a bond breaks in its longest
// mode. `longest`: m, of the boundary edges, or the size of the largest face.
double longest_gap(double longest, const BondRules& rules);

}  // namespace pulvis
