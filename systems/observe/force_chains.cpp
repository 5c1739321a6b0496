// force_chains: which particles pass the load on to each other.
//
// Source   systems/observe/force_chain_kernel.hpp
// Runs     on sampled steps, after particle_stress and contact_network
// Active   when the scene requests contacts
#include "systems/observe/force_chain_kernel.hpp"
#include "systems/observe/systems.hpp"

namespace pulvis {

void force_chains::operator()() const {
  const Row<Particle> particle;
  std::vector<kernels::PlaneStress> stresses;
  std::vector<Point> centres;
  for (const int slot : bodies->slot_of_number) {
    const Chunk chunk{slot / lane_count};
    const int lane = slot % lane_count;
    const auto s = stress.chunk(chunk);
    const auto x = centre.chunk(chunk);
    stresses.push_back({s(particle, 0)[lane], s(particle, 1)[lane], s(particle, 3)[lane]});
    centres.push_back({x(particle, 0)[lane], x(particle, 1)[lane]});
  }
  std::vector<kernels::TouchingPair<2>> touching;
  for (const ContactLink<TwoD>& link : network->pairs)
    touching.push_back({link.first, link.second, link.period});
  chains->chain = kernels::force_chains(stresses, centres, touching);
}

}  // namespace pulvis
