// An outline of the same form and another size.
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis {

Outline scaled(const Outline& outline, double factor);

}  // namespace pulvis
