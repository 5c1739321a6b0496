// What SIGINT, SIGTERM and SIGUSR1 do, in the two parts of a command's life.
#pragma once

namespace pulvis {

// While nothing has been written: a signal ends the program at once, with exit code 130, whatever it is doing.
void leave_at_interrupts();
// From here on there is something to keep: a signal is a wish (engine/interruption.hpp), heeded between two steps.
void take_interrupts();
bool interrupted();

}  // namespace pulvis
