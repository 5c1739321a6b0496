// Classes of particles that differ from one in the scene by their size alone.
#pragma once

#include <fmt/format.h>

#include <cstddef>

namespace pulvis {

// The class of particles of another size than their own class has; the same for the same size. `resize(spec, scale)` scales
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
  spec.name += fmt::format("#{}", number);  // a sign that names in scenes do not have
  particles.push_back(spec);
  return static_cast<int>(particles.size()) - 1;
}

}  // namespace pulvis
