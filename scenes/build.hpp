// From a scene to the world that its systems run in: tables, and the columns that the scene asks for.
#pragma once

#include <memory>

#include "engine/ranks/ranks.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Places the particles, checks that they have room (throws SceneError), and fills a world: with all of them, or as one of
// several ranks with its share.
std::unique_ptr<World> build_world(const Scene& scene, Ranks* ranks = nullptr);
// The same with room for all particles and none of them in it: what the root of several ranks fetches results into.
std::unique_ptr<World> build_whole_world(const Scene& scene);

}  // namespace pulvis
