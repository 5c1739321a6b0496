// The initial state of a scene: whether the file is a valid state, and of the same powder.
#pragma once

#include <cstdint>

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

void check_initial_state(const Scene& scene, std::uint64_t powder_hash,
                         const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
