// The memory that a scene will need, known before any of it is allocated.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/machine_memory.hpp"
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

// One of the machines of a run, and how much memory it has left.
struct MachineMemory {
  std::string name{};  // empty: this machine, the only one
  int ranks = 1;
  std::uint64_t left = left_by_machine();        // bytes, for its ranks together
  std::uint64_t left_to_each = left_by_shell();  // bytes
};

// Particles and contacts are shared by all ranks; results are gathered by the root, which is on the first machine. Throws
// OutputError where a machine does not have that much free memory.
MemoryNeed require_memory(const Scene& scene,
                          const std::vector<MachineMemory>& machines = {MachineMemory()});

}  // namespace pulvis
