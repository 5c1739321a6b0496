// Builds the world that a scene's systems run in: its tables, and the columns that the scene needs.
#pragma once

#include <memory>

#include "engine/ranks/ranks.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Places the particles, checks that they do not overlap (throws SceneError), and fills a world with all of them or, as
// one of several ranks, with this rank's share.
std::unique_ptr<World> build_world(const Scene& scene, Ranks* ranks = nullptr);
// The same with room for all particles but without any: the root of several ranks gathers results into it.
std::unique_ptr<World> build_whole_world(const Scene& scene);

}  // namespace pulvis
