// What the program tells the shell.
#pragma once

namespace pulvis {

enum class ExitCode {
  done = 0,
  usage = 2,       // bad command line or scene
  run_failed = 3,  // the physics went bad (systems/body/element_health), or not as expected
  machine = 4,     // disk, memory
  interrupted = 130,
};

}  // namespace pulvis
