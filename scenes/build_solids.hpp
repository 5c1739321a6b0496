// Builds the world for a scene in three dimensions.
#pragma once

#include <memory>

#include "engine/world.hpp"
#include "scenes/ranks/share.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Throws SceneError for errors seen only in placed particles: overlaps, travel beyond full density. With
// several ranks, builds the part of one of them.
std::unique_ptr<World> build_world(const Scene& scene, const Part& part);

}  // namespace pulvis::space
