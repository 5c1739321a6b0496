// Checks of what a stage says of forces and early ends, across its keys.
#pragma once

#include <string>

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// The way a servo pushes; zero where neither it nor its tool says.
Vec2 direction_of(const ServoSpec& servo, const Scene& scene);

void check_servos(const Scene& scene, const StageSpec& stage, const std::string& path,
                  const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
