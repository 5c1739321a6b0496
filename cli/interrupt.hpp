// What SIGINT, SIGTERM and SIGUSR1 do before and after a command has started to write.
#pragma once

namespace pulvis {

// While nothing has been written: a signal ends the program at once, with exit code 130.
void leave_at_interrupts();
// From here on there is output to keep: a signal is a request (engine/interruption.hpp), handled between steps.
void take_interrupts();
bool interrupted();

}  // namespace pulvis
