// Random packings are made, and those in files read, once a scene has been read and found right.
#pragma once

#include "scenes/language/table_reader.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// Places the particles of every random and CSV packing, adds a particle class for every size that is not that of its
// class, and puts the tools that rest on a packing on it.
void fill_packings(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis::space
