// The ranks that this process is one of, where it was started as one of several: by mpirun or srun.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "engine/ranks/ranks.hpp"

namespace pulvis {

// There is no MPI to be had: not built, not installed, or of another build. Of the machine.
class NoMpi : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Programs of several versions, or processors of several kinds: refused on all ranks. what() is empty on all but the
// root, which speaks for them.
class UnlikeRanks : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What the starter left in the environment says: Open MPI's mpirun, or a step of Slurm's with PMIx or PMI-2.
bool started_as_rank();

// Loads the library that speaks MPI. Throws NoMpi.
void require_mpi();

// Null where the process is alone. All ranks call it; once in a process. Throws NoMpi, UnlikeRanks.
std::unique_ptr<Ranks> join_ranks();

// All ranks run the same program, as each of them describes its own. Collective; throws UnlikeRanks.
void require_alike(Ranks& ranks, const std::string& own);

// The processors that this rank may use, each shared evenly by the ranks that may use it; at least 1. Collective.
int threads_of_rank(Ranks& ranks);

}  // namespace pulvis
