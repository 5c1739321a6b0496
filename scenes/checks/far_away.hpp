// Particles too far from the origin for their size: positions are double-precision numbers relative to it, so their
// round-off grows with the distance, and contact gaps are differences of positions.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct FarParticle {
  std::string key;  // of the scene: what placed it
  SourceMark mark;
  std::string name;     // of its class
  double distance = 0;  // m, its largest coordinate
  double size = 0;      // m
};

// Throws SceneError if the round-off of its position is too large a part of its size.
void refuse_far(const Scene& scene, const FarParticle& particle);

// Of all `bodies` of a scene in the plane or in space, the one for which round-off counts most. `size_of` gives the size
// of a class, m.
template <class SizeOf>
void check_distance(const Scene& scene, const std::vector<BodySpec>& bodies,
                    const SizeOf& size_of) {
  std::map<int, double> sizes;
  const BodySpec* worst = nullptr;
  FarParticle found{"particle", {}, "", 0, 1};
  for (const BodySpec& body : bodies) {
    const auto [size, fresh] = sizes.try_emplace(body.particle, 0);
    if (fresh) size->second = size_of(body);
    const double distance = body.position.cwiseAbs().maxCoeff();
    if (distance * found.size <= found.distance * size->second) continue;
    worst = &body;
    found.distance = distance;
    found.size = size->second;
  }
  if (worst == nullptr) return;
  found.mark = worst->mark;
  found.name = scene.class_of(*worst).name;
  for (std::size_t i = 0; i < scene.packings.size(); ++i)
    if (scene.packings[i].mark == worst->mark) found.key = fmt::format("packing[{}]", i);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].mark == worst->mark) found.key = fmt::format("body[{}].position", i);
  refuse_far(scene, found);
}

}  // namespace pulvis
