// What a scene in three dimensions can ask to be observed of its particles. Written on sampled steps only; nothing in a
// step reads it.
#pragma once

#include "components/entities.hpp"

namespace pulvis::space {

// ---- output.particle_stress -----------------------------------------------------------------------
struct ParticleStress : Component<Particle, double, 6> {
  static constexpr ComponentInfo info{
      "stress", "Pa", "Cauchy, mean over the particle: xx yy zz xy yz zx; tension > 0"};
};
struct DeformedVolume : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"deformed_volume", "m^3", "of its elements now"};
};
struct ParticleCentre : Component<Particle, double, 3> {
  static constexpr ComponentInfo info{"centre", "m",
                                      "middles of its elements, weighted with their volumes"};
};

}  // namespace pulvis::space
