// An outline of the same shape and another size.
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis {

Outline scaled(const Outline& outline, double factor);

}  // namespace pulvis
