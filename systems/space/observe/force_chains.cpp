// force_chains: which particles form the force chains, in three dimensions.
//
// Source   systems/observe/force_chain_kernel.hpp
// Runs     in sampled steps, after particle_stress and contact_network
// Active   if the scene asks for contacts
#include "systems/observe/force_chain_kernel.hpp"

#include "systems/space/observe/network_kernel.hpp"
#include "systems/space/observe/systems.hpp"

namespace pulvis::space {

void force_chains::operator()() const {
  const Row<Particle> particle;
  std::vector<pulvis::kernels::MajorCompression<3>> loads;
  std::vector<Point> centres;
  for (const int slot : bodies->slot_of_number) {
    const Chunk chunk{slot / lane_count};
    const int lane = slot % lane_count;
    const auto s = stress.chunk(chunk);
    const auto x = centre.chunk(chunk);
    std::array<double, 6> mean;
    for (int k = 0; k < 6; ++k) entry(mean, k) = s(particle, k)[lane];
    loads.push_back(kernels::major_compression(mean));
    centres.push_back({x(particle, 0)[lane], x(particle, 1)[lane], x(particle, 2)[lane]});
  }
  std::vector<pulvis::kernels::TouchingPair<3>> touching;
  for (const ContactLink<ThreeD>& link : network->pairs)
    touching.push_back({link.first, link.second});
  chains->chain = pulvis::kernels::chains_of<3>(loads, centres, touching);
}

}  // namespace pulvis::space
