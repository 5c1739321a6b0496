// What a scene requests under [output] beyond forces and energies: its columns and resources, its series
// and fields.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Rejects output that is not available for this scene.
void check_output(const Scene& scene, const schema::Origins& origins, Problems& problems);

// Adds what the scene requests to a world that has its bodies.
void add_observed(World& world, const Scene& scene);

}  // namespace pulvis
