#include "cli/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace pulvis {
namespace {

std::atomic<bool> asked_to_stop{false};
void ask_to_stop(int) { asked_to_stop = true; }

}  // namespace

void take_interrupts() {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  std::signal(SIGXFSZ, SIG_IGN);  // a full quota is an error, not a death
}

bool interrupted() { return asked_to_stop; }

}  // namespace pulvis
