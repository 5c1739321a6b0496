// Scenes in three dimensions with packings, for tests; and what is measured of them.
#pragma once

#include <memory>
#include <numbers>
#include <stdexcept>

#include "scenes/packing/fill_packings.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

inline Scene scene_of(const std::vector<ParticleShape>& shapes, const PackingSpec& packing,
                      std::uint64_t seed = 1) {
  Scene scene;
  scene.file = "packed.toml";
  scene.seed = seed;
  scene.dimension = 3;
  for (const ParticleShape& shape : shapes) {
    ParticleSpec particle;
    particle.name = std::string(1, static_cast<char>('a' + scene.particles.size()));
    particle.shape = shape;
    scene.particles.push_back(particle);
  }
  scene.packings = {packing};
  return scene;
}

// Throws SceneError, as a reader does.
inline PackingSpec filled(Scene& scene) {
  Problems problems(scene.file, {});
  fill_packings(scene, {{"packing[0]", {{7, 1}, -1}}, {"packing[0].density", {{8, 3}, -1}}},
                problems);
  problems.throw_if_any();
  return scene.packings.at(0);
}

// `count` particles of each class in a cube of such an edge.
inline PackingSpec in_box(double edge, const std::vector<int>& counts) {
  PackingSpec packing;
  packing.kind = PackingSpec::Kind::random;
  packing.container.width = packing.container.depth = edge;
  for (const int count : counts) {
    MixtureClass mixed;
    mixed.particle = static_cast<int>(packing.classes.size());
    mixed.number = count;
    packing.classes.push_back(mixed);
  }
  return packing;
}

inline PackingSpec in_cylinder(double diameter, const std::vector<int>& counts) {
  PackingSpec packing = in_box(0, counts);
  packing.container.kind = ContainerSpec::Kind::cylinder;
  packing.container.diameter = diameter;
  return packing;
}

}  // namespace pulvis::space
