// The state that a scene begins with: whether it is one, and of the same powder.
#pragma once

#include <cstdint>

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

void check_initial_state(const Scene& scene, std::uint64_t powder_hash,
                         const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
