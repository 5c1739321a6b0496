#include "cli/interrupt.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "cli/exit_code.hpp"
#include "engine/interruption.hpp"

namespace pulvis {
namespace {

void ask(int) { ask_to_stop(); }

// Only async-signal-safe calls.
void leave(int) {
  constexpr std::string_view told =
      "pulvis: interrupted before the first step; nothing was written\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, told.data(), told.size());
  _exit(static_cast<int>(ExitCode::interrupted));
}

void answer_interrupts(void (*handler)(int)) {
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
  std::signal(SIGUSR1, handler);  // mpirun and Slurm forward it without killing soon after
  std::signal(SIGXFSZ, SIG_IGN);  // a full quota is an error, and must not kill the process
}

}  // namespace

void leave_at_interrupts() { answer_interrupts(leave); }
void take_interrupts() { answer_interrupts(ask); }
bool interrupted() { return asked_to_stop(); }

}  // namespace pulvis
