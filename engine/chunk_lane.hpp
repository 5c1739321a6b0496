// Where a particle's rows stand: in which chunk, and in which lane of it. Slots count them one after the other.
#pragma once

#include "engine/component.hpp"

namespace pulvis {

struct ChunkLane {
  Chunk chunk;
  int lane;

  constexpr ChunkLane(Chunk c, int l) : chunk(c), lane(l) {}
  constexpr explicit ChunkLane(int slot) : chunk{slot / lane_count}, lane(slot % lane_count) {}
  constexpr int slot() const { return chunk.index * lane_count + lane; }
};

}  // namespace pulvis
