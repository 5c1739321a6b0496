// What particle_stress has in common for all elements: means from the sums over a particle's elements.
#pragma once

#include <array>

#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {

// Over the elements of eight particles, each weighted with its size: area or volume.
template <class D>
struct StressSums {
  std::array<Lane, D::axes == 2 ? 3 : 5> deviator{};  // xx yy xy, yz zx
  Lane mean{}, size{};
  std::array<Lane, D::axes> middle{};

  // zz is minus the sum of xx and yy.
  template <class System>
  void store_means(const System& s, Chunk chunk) const {
    const Row<Particle> particle;
    const auto stress = s.stress.chunk(chunk);
    stress(particle, 0) = (deviator[0] + mean) / size;
    stress(particle, 1) = (deviator[1] + mean) / size;
    stress(particle, 2) = (mean - (deviator[0] + deviator[1])) / size;
    for (int k = 3; k < ParticleStress<D>::count; ++k)
      stress(particle, k) = entry(deviator, k - 1) / size;
    s.size.chunk(chunk)(particle) = size;
    for (int k = 0; k < D::axes; ++k) s.centre.chunk(chunk)(particle, k) = entry(middle, k) / size;
  }
};

}  // namespace pulvis
