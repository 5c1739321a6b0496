// Links the world of one rank to those of the others. Absent in a scene that runs in a single process.
//
// Ranks own whole chunks. A contact row is computed only by the rank that owns the sampled particle; the rank that
// owns the other particle has the same row, among its own in the same order, and receives the results.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/component.hpp"
#include "engine/ranks/ranks.hpp"

namespace pulvis {

struct RankLink {
  static constexpr const char* resource_name = "rank_link";
  struct Neighbour {
    int rank;
    std::vector<int> send, receive;  // slots, ascending, or rows in their order
  };

  Ranks* ranks = nullptr;
  std::vector<int> owner;            // [chunks]
  std::vector<Neighbour> border;     // particles near those of the other rank at the last rebuild
  std::vector<Neighbour> outlines;   // the ones that rows refer to: exchanged in every step
  std::vector<Neighbour> rows;       // contact rows, or pairs of particles in three dimensions
  bool outlines_sent = false;  // and not yet received
  // A failure of this rank in this step, and its position in the step list; sent to the others at the end of the step.
  std::string failure;
  int failed_at = 0;
  bool any_failed = false;  // on any rank

  int owner_of(int slot) const { return owner[static_cast<std::size_t>(slot / lane_count)]; }

  template <class Bytes>
  void state(Bytes&) {}  // a checkpoint covers all ranks
};

}  // namespace pulvis
