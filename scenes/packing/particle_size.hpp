// Size of particles, in either dimension.
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis {

double content_of(const Scene& scene, const BodySpec& body);  // area, m^2, or volume, m^3
double size_of(const Scene& scene, const BodySpec& body);     // m, in the order of its diameter

}  // namespace pulvis
