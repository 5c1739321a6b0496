// From a scene to the world that its systems run in: tables, and the columns that the scene asks for.
#pragma once

#include <memory>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Places the particles, checks that they have room (throws SceneError), and fills a world.
std::unique_ptr<World> build_world(const Scene& scene);

}  // namespace pulvis
