#include "scenes/ranks/share.hpp"

#include "components/ranks.hpp"
#include "scenes/ranks/divide.hpp"

namespace pulvis {
namespace {

// Mean over the particles of a chunk.
std::array<double, 3> mean_of_chunk(const Bodies& bodies,
                                    const std::vector<std::array<double, 3>>& centre, int chunk) {
  std::array<double, 3> sum{};
  int particles = 0;
  for (int slot = chunk * lane_count; slot < (chunk + 1) * lane_count; ++slot) {
    if (entry(bodies.slots, slot).number == Bodies::empty_slot) continue;
    ++particles;
    for (std::size_t k = 0; k < 3; ++k) sum[k] += entry(centre, slot)[k];
  }
  for (double& x : sum) x /= particles;
  return sum;
}

}  // namespace

std::unique_ptr<World> empty_world(const Part& part) {
  const bool some = part.ranks != nullptr || part.empty;
  return std::make_unique<World>(some ? Buffer::Kind::sparse : Buffer::Kind::dense);
}

void hold_part(World& world, const Part& part, Bodies& bodies,
               const std::vector<std::array<double, 3>>& centre, const std::vector<double>& cost) {
  const auto chunks = static_cast<std::size_t>(bodies.chunks());
  if (part.empty) bodies.hold(std::vector<bool>(chunks));
  if (part.ranks == nullptr) return;
  std::vector<std::array<double, 3>> of_chunk;
  for (int chunk = 0; chunk < bodies.chunks(); ++chunk)
    of_chunk.push_back(mean_of_chunk(bodies, centre, chunk));
  RankLink& link = world.emplace<RankLink>();
  link.ranks = part.ranks;
  link.owner = divide_chunks(of_chunk, cost, part.ranks->count());
  std::vector<bool> owns;
  for (const int owner : link.owner) owns.push_back(owner == part.ranks->rank());
  bodies.hold(owns);
  world.hold(owns);
}

}  // namespace pulvis
