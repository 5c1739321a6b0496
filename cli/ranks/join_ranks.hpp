// The ranks that this process belongs to, if it was started as one of several by mpirun or srun.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "engine/ranks/ranks.hpp"
#include "scenes/memory_need.hpp"

namespace pulvis {

// MPI is not available: not built, not installed, or from another build. A machine error.
class NoMpi : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Ranks with different program versions or processor types: refused on all ranks. what() is empty on all but the
// root, which reports for them.
class UnlikeRanks : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Judged by the launcher's environment variables: Open MPI's mpirun, or a Slurm step with PMIx or PMI-2.
bool started_as_rank();

// The same, or as the only one: mpirun then cannot be started from here.
bool started_by_mpirun();

// Loads the MPI library. Throws NoMpi.
void require_mpi();

// Null if the process is alone. Called by all ranks, once per process. Throws NoMpi, UnlikeRanks.
std::unique_ptr<Ranks> join_ranks();

// Checks that all ranks have the same text about themselves; `rule` begins the refusal. Collective; throws UnlikeRanks.
void require_alike(Ranks& ranks, const std::string& own, const std::string& rule);

struct MachineShare {
  int threads = 1;  // processors for this rank; each is shared evenly by the ranks that may use it
  std::vector<MachineMemory> machines{};  // of all ranks, that of the root first; only on the root
};
// Collective.
MachineShare machine_share_of(Ranks& ranks);

}  // namespace pulvis
