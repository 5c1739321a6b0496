// SIGINT and SIGTERM end a run between two steps.
#pragma once

namespace pulvis {

void take_interrupts();
bool interrupted();

}  // namespace pulvis
