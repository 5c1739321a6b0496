// Whether the bonds that a scene makes at its start are there, and whether its mesh resolves how they break.
//
// Zone     Ahead of a crack the bond softens over l = 0.88 E' G/sigma_c^2, E' = E/(1 - nu^2) of the softer side
//          (Hillerborg, Modeer & Petersson 1976); at least three elements should lie in it (Turon, Davila, Camanho &
//          Costa 2007). In shear tau_c and G_II stand for sigma_c and G
// Valid    for interfaces longer than their zone: a shorter one breaks as a whole, and one of a single boundary edge has
//          no crack that runs along it
#pragma once

#include <string>
#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Throws SceneError where a law of bonds with origin = "initial" has bonded nothing. `world`: as it starts.
void require_initial_bonds(const Scene& scene, const World& world);

// One line for each such law whose zone is shorter than three boundary edges.
std::vector<std::string> bond_warnings(const Scene& scene, const World& world);

}  // namespace pulvis
