// The memory that a scene will need, known before any of it is allocated.
#pragma once

#include <cstdint>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct MemoryNeed {
  std::uint64_t columns = 0;   // bytes, for nodes, elements, outlines: exact but for alignment
  std::uint64_t contacts = 0;  // rows of a dense packing; they come and go
  std::uint64_t results = 0;   // a frame being written to disk
  std::uint64_t program = 0;   // the program and its libraries
  std::uint64_t total() const { return columns + contacts + results + program; }
};

// For scenes of particles; their packings must be filled.
MemoryNeed memory_need(const Scene& scene);

// Of the ranks of a run, those on this machine.
struct RanksHere {
  int here = 1, all = 1;
};

// Their need: particles and contacts are shared by all ranks, results are gathered by the root, taken to be here. Throws
// OutputError where this machine does not have that much free memory.
MemoryNeed require_memory(const Scene& scene, const RanksHere& ranks = {});

}  // namespace pulvis
