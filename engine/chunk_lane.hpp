// Location of a particle's rows: its chunk, and its lane in that chunk. Slots number all lanes consecutively.
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
