#include "scenes/packing/particle_size.hpp"

#include <cmath>

#include "scenes/outlines/outline.hpp"
#include "scenes/packing/solids/rigid_shape.hpp"

namespace pulvis {

double content_of(const Scene& scene, const BodySpec& body) {
  const ParticleSpec& particle = scene.class_of(body);
  return scene.in_space() ? space::volume_of(particle.shape) : outline_area(particle.outline);
}

double size_of(const Scene& scene, const BodySpec& body) {
  const ParticleSpec& particle = scene.class_of(body);
  return scene.in_space() ? space::diameter_of(particle.shape)
                          : std::sqrt(outline_area(particle.outline));
}

}  // namespace pulvis
