// bond_totals: sums over the bonds, and which ones broke.
//
// Runs     every step, after bond_forces and contact_totals: dissipation accumulates over steps
// Active   when the scene has bonds
#include <algorithm>
#include <array>

#include "components/run_state.hpp"
#include "engine/state_bytes.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {
namespace {

// Over all blocks of this rank.
struct Sums {
  enum Exact { energy, contact_energy, fracture, area, friction_work, damping_work, exact };
  enum Count { rows, cracks, counts };
  std::array<ExactSum, exact> sum;
  std::array<std::int64_t, counts> count{};
  std::vector<Crack> broken;

  void add(const std::vector<BondBlock>& blocks) {
    for (const BondBlock& block : blocks) {
      sum[energy].add(block.energy);
      sum[contact_energy].add(block.contact_energy);
      sum[fracture].add(block.fracture);
      sum[area].add(block.area);
      sum[friction_work].add(block.friction_work);
      sum[damping_work].add(block.damping_work);
      count[rows] += block.rows;
      count[cracks] += std::ssize(block.cracks);
      broken.insert(broken.end(), block.cracks.begin(), block.cracks.end());
    }
  }
};

// What broke on any rank, in single-process order: chunk by chunk, each owned by one rank; bonds with tools last.
std::vector<Crack> cracks_of_ranks(RankLink& link, std::vector<Crack> own) {
  StateWriter writer;
  writer(own);
  const auto count = static_cast<std::size_t>(link.ranks->count());
  std::vector<Crack> all;
  for (const Ranks::Bytes& bytes :
       link.ranks->all_to_all(std::vector<Ranks::Bytes>(count, writer.bytes()))) {
    StateReader reader(bytes);
    std::vector<Crack> cracks;
    reader(cracks);
    all.insert(all.end(), cracks.begin(), cracks.end());
  }
  std::ranges::stable_sort(all, {}, [](const Crack& crack) {
    return std::pair(crack.other < 0, crack.slot / lane_count);
  });
  return all;
}

}  // namespace

void bond_totals::operator()() const {
  Sums of;
  if (pairs) of.add((*pairs)->blocks);
  if (tools) of.add((*tools)->blocks);
  sum_of_ranks(link, of.sum, of.count);
  if (link && of.count[Sums::cracks] > 0) of.broken = cracks_of_ranks(**link, std::move(of.broken));
  totals->touching += of.count[Sums::rows];
  for (const Crack& crack : of.broken) {
    bonds->crack_size += crack.size;
    bonds->cracks.push_back(crack);
  }
  bonds->energy = of.sum[Sums::energy].value();
  bonds->fracture += of.sum[Sums::fracture].value();
  bonds->area = of.sum[Sums::area].value();
  totals->contact_energy += of.sum[Sums::contact_energy].value();
  totals->friction_work += of.sum[Sums::friction_work].value();
  totals->damping_work += of.sum[Sums::damping_work].value();
}

}  // namespace pulvis
