// What the system of docs/extending.md finds; put behind it by example_source.py.
#pragma once

#include <gtest/gtest.h>

#include "engine/system.hpp"

namespace pulvis {

TEST(ParticleSpinOfTheDocs, IsThatOfTheSpinningDisc) {
  Experiment e("basic/spinning-disc.toml");
  World& world = e.simulation.world();
  world.add<ParticleSpin>();
  make_system<particle_spin>(world, "particle_spin").run(Chunk{0});
  const int slot = world.resource<Bodies>().slot_of_number[0];
  EXPECT_NEAR(world.column<ParticleSpin>().lanes()[0][slot] / 40000, 1, 1e-12);
}

}  // namespace pulvis
