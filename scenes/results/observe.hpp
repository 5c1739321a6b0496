// What a scene asks for under [output] beyond forces and energies: its columns and resources, its series
// and fields.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Refuses what cannot be observed of this scene.
void check_output(const Scene& scene, const schema::Origins& origins, Problems& problems);

// Gives a world that has its bodies what the scene asks for.
void add_observed(World& world, const Scene& scene);

}  // namespace pulvis
