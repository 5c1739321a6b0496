// The program's interface to the MPI library, which it loads when a run has ranks.
#pragma once

#include <cstddef>
#include <string>

#include "cli/identity.hpp"
#include "engine/ranks/ranks.hpp"

namespace pulvis {

struct MpiPlugin {
  static constexpr const char* library = "libpulvis_mpi.so";
  static constexpr const char* entry = "pulvis_mpi_plugin";  // const MpiPlugin* entry()

  const char*
      build;  // its build_identity(); the rest may only be used if it equals that of the program
  // Initialises MPI, once per process. Messages are cut into parts of at most `most_bytes`, since MPI counts in int.
  Ranks* (*join)(std::size_t most_bytes);
};

inline std::string build_identity() { return program_version() + " (" + program_commit() + ")"; }

}  // namespace pulvis
