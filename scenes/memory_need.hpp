// What a scene will take of memory, known before any of it is taken.
#pragma once

#include <cstdint>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct MemoryNeed {
  std::uint64_t columns = 0;   // bytes, of nodes, elements, outlines: exact but for alignment
  std::uint64_t contacts = 0;  // rows of a dense packing; they come and go
  std::uint64_t results = 0;   // a frame on its way to the disk
  std::uint64_t program = 0;   // and its libraries
  std::uint64_t total() const { return columns + contacts + results + program; }
};

// Of the scenes of particles; their packings are filled.
MemoryNeed memory_need(const Scene& scene);

// The same. Throws OutputError where this machine has not got it now.
MemoryNeed require_memory(const Scene& scene);

}  // namespace pulvis
