// Whether the bonds that a scene creates at its start exist, and whether the mesh resolves their fracture.
//
// Zone     Ahead of a crack the bond softens over l = 0.88 E' G/sigma_c^2, E' = E/(1 - nu^2) of the softer side
//          (Hillerborg, Modeer & Petersson 1976); it should span at least three elements (Turon, Davila, Camanho &
//          Costa 2007). In shear, tau_c and G_II replace sigma_c and G
// Valid    for interfaces longer than their zone: a shorter one breaks as a whole, and one with a single boundary edge
//          has no crack that runs along it
#pragma once

#include <string>
#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Throws SceneError where a bond law with origin = "initial" has bonded nothing. `world`: in its initial state.
void require_initial_bonds(const Scene& scene, const World& world);

// One line for each such law whose zone is shorter than three boundary edges.
std::vector<std::string> bond_warnings(const Scene& scene, const World& world);

}  // namespace pulvis
