// The yield stress that all materials of a scene share.
#pragma once

#include <optional>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// Pa; none where materials differ in it, or one has none.
std::optional<double> common_yield_stress(const Scene& scene);

}  // namespace pulvis
