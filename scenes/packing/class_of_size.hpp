// Particle classes that differ from a class in the scene only by size.
#pragma once

#include <fmt/format.h>

#include <cstddef>

namespace pulvis {

// The class of particles whose size differs from that of their own class; one class per size. `resize(spec, scale)` scales
// the shape of a new one.
template <class Particles, class Resize>
int class_of_size(Particles& particles, int particle, double scale, const Resize& resize) {
  if (scale == 1) return particle;
  int number = 1;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (particles[p].class_of != particle) continue;
    if (particles[p].scale == scale) return static_cast<int>(p);
    ++number;
  }
  auto spec = particles[static_cast<std::size_t>(particle)];
  spec.class_of = particle;
  spec.scale = scale;
  resize(spec, scale);
  spec.name += fmt::format("#{}", number);  // a character that names in scenes cannot contain
  particles.push_back(spec);
  return static_cast<int>(particles.size()) - 1;
}

}  // namespace pulvis
