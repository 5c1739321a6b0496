// What links the world of a rank with those of the others. A scene that runs in one process has none of it.
//
// Ranks own whole chunks. A contact row is computed by the rank that owns the sampled particle, and by no other; the rank that
// owns the other particle has the same row, among its own in the same order, and is told what it does.
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
  std::vector<Neighbour> border;     // particles near those of the other rank when the rows were made
  std::vector<Neighbour> outlines;   // of them, those that rows look at: told in every step
  std::vector<Neighbour> rows;       // contact rows, or pairs of particles in three dimensions
  bool outlines_sent = false;  // and not yet awaited
  // What broke on this rank in this step, and at which position of the step list; told to the others at its end.
  std::string failure;
  int failed_at = 0;
  bool any_failed = false;  // on any rank

  int owner_of(int slot) const { return owner[static_cast<std::size_t>(slot / lane_count)]; }

  template <class Bytes>
  void state(Bytes&) {}  // a checkpoint is of all ranks
};

}  // namespace pulvis
