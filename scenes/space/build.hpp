// From a scene in three dimensions to the world that is computed.
#pragma once

#include <memory>

#include "engine/world.hpp"
#include "scenes/ranks/share.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Throws SceneError for what only the placed particles show: overlaps, travel beyond full density. Of several
// ranks the part of one of them.
std::unique_ptr<World> build_world(const Scene& scene, const Part& part);

}  // namespace pulvis::space
