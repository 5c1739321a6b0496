// force_chains: which particles pass the load on to each other.
//
// Source   systems/observe/force_chain_kernel.hpp
// Runs     on sampled steps, after particle_stress and contact_network
// Active   when the scene requests contacts
#include "engine/entry.hpp"
#include "systems/observe/force_chain_kernel.hpp"
#include "systems/observe/systems.hpp"

namespace pulvis {

template <class D>
void force_chains<D>::operator()() const {
  const Row<Particle> particle;
  std::vector<kernels::MajorCompression<D::axes>> loads;
  std::vector<typename D::Point> centres;
  for (const int slot : bodies->slot_of_number) {
    const Chunk chunk{slot / lane_count};
    const int lane = slot % lane_count;
    const auto s = stress.chunk(chunk);
    const auto x = centre.chunk(chunk);
    std::array<double, ParticleStress<D>::count> mean;
    for (int k = 0; k < ParticleStress<D>::count; ++k) entry(mean, k) = s(particle, k)[lane];
    loads.push_back(kernels::major_compression(mean));
    typename D::Point& middle = centres.emplace_back();
    for (int k = 0; k < D::axes; ++k) entry(middle, k) = x(particle, k)[lane];
  }
  std::vector<kernels::TouchingPair<D::axes>> touching;
  for (const ContactLink<D>& link : network->pairs)
    touching.push_back({link.first, link.second, link.period});
  chains->chain = kernels::chains_of<D::axes>(loads, centres, touching);
}
template struct force_chains<TwoD>;
template struct force_chains<ThreeD>;

}  // namespace pulvis
