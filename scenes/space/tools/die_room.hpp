// The room around a powder, which its relative density refers to: the box between six planes, or a round die between two
// planes or punches.
#pragma once

#include <array>
#include <optional>

#include "components/die_room.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// None where other tools stand beside them, or some are missing. Normals must be along the axes, or along the die's.
std::optional<DieRoom> die_room(const Scene& scene);

}  // namespace pulvis::space
