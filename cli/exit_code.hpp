// Exit codes of the program.
#pragma once

namespace pulvis {

enum class ExitCode {
  done = 0,
  usage = 2,       // bad command line or scene
  run_failed = 3,  // simulation failed (systems/body/element_health), or unexpected result
  machine = 4,     // disk, memory
  interrupted = 130,
};

}  // namespace pulvis
