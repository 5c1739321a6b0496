// What the program knows of the library that speaks MPI, which it loads where a run has ranks.
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
      build;  // build_identity() of its own; the rest is only to be used where it is that of the program
  // Initialises MPI, once in a process. A message is cut into parts of `most_bytes` at most, since MPI counts in int.
  Ranks* (*join)(std::size_t most_bytes);
};

inline std::string build_identity() { return program_version() + " (" + program_commit() + ")"; }

}  // namespace pulvis
