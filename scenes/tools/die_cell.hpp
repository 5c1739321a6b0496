// The box between four tools whose normals look along +x, -x, +y, -y: what relative density refers to.
// Polylines that begin behind one of them take nothing of it.
#pragma once

#include <optional>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct DieCell {
  int left, right, bottom, top;  // tools
};
std::optional<DieCell> die_cell(const Scene& scene);

}  // namespace pulvis
