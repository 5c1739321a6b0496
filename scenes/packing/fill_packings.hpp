// Generates random packings and reads those in files, once a scene has been read and checked.
#pragma once

#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Places the particles of every random and CSV packing, adds a particle class for every size that differs from that of
// its class, and places the tools that rest on a packing. A random packing in a cell gives the cell its height.
void fill_packings(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
