// The yield stresses of a scene's materials.
#pragma once

#include <optional>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// Whether any material has one.
bool any_material_yields(const Scene& scene);

// Pa, the one shared by all; none where materials differ, or one has none.
std::optional<double> common_yield_stress(const Scene& scene);

}  // namespace pulvis
