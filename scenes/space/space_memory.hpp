// The memory that a scene in three dimensions will need, known before any of it is allocated.
#pragma once

#include <cstdint>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

struct SpaceMemory {  // bytes, as in MemoryNeed (scenes/memory_need.hpp)
  std::uint64_t columns = 0, contacts = 0, results = 0;
};
SpaceMemory memory_of(const Scene& scene);

}  // namespace pulvis::space
