// pulvis run --ranks N: starts this program again, N times, with Open MPI's mpirun.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct RankLaunch {
  std::filesystem::path program;   // absolute path
  std::vector<std::string> words;  // of its command line
  int ranks;
  std::filesystem::path folder;  // for the run's results
};

// Starts the ranks and waits for them to end. SIGINT, SIGTERM and SIGUSR1 reach them as SIGUSR1, which mpirun forwards; they
// also get it if this process is killed. Returns the exit code of the rank that failed first. If a rank was killed or mpirun
// failed, reports it and returns ExitCode::machine.
ExitCode launch_ranks(const RankLaunch& launch);

// Throws OutputError if files of this size cannot be written into `folder`: Open MPI then starts only some ranks, which wait
// for the others forever.
void require_room_to_start(const std::filesystem::path& folder, std::uintmax_t bytes);

// The words of a command line without --ranks and its number.
std::vector<std::string> without_ranks(const std::vector<std::string>& words);

// The absolute path of this program.
std::filesystem::path own_program();

}  // namespace pulvis
