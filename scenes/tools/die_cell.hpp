// The box between four tools with normals along +x, -x, +y, -y: the volume for the relative density.
// Polylines that begin behind one of them do not reduce it.
#pragma once

#include <optional>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct DieCell {
  int left, right, bottom, top;  // tools
};
std::optional<DieCell> die_cell(const Scene& scene);

}  // namespace pulvis
