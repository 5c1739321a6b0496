// The room around a powder to which its relative density refers: the box between six planes, or a round die between two
// planes or punches.
#pragma once

#include <array>
#include <optional>

#include "components/die_room.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// None if there are other tools besides them, or some are missing. Normals must be along the axes, or the die's axis.
std::optional<DieRoom> die_room(const Scene& scene);

}  // namespace pulvis
