// pulvis run --ranks N: this program again, N times, by Open MPI's mpirun.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct RankLaunch {
  std::filesystem::path program;   // by its whole path
  std::vector<std::string> words;  // of its command line
  int ranks;
  std::filesystem::path folder;  // of the run's results
};

// Starts the ranks and waits for their end. SIGINT, SIGTERM and SIGUSR1 reach them as SIGUSR1, which mpirun hands on; they
// also get it where this process is killed. Returns the exit code of the rank that failed first. Where a rank was killed,
// or mpirun failed, tells so and returns ExitCode::machine.
ExitCode launch_ranks(const RankLaunch& launch);

// Throws OutputError where `folder` has no room for so many bytes: with a full one Open MPI starts some ranks, which then wait
// for the others for ever.
void require_room_to_start(const std::filesystem::path& folder, std::uintmax_t bytes);

// The words of a command line less --ranks and its number.
std::vector<std::string> without_ranks(const std::vector<std::string>& words);

// This program, by its whole path.
std::filesystem::path own_program();

}  // namespace pulvis
