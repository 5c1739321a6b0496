#include "cli/tell.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "cli/exit_code.hpp"

namespace pulvis {
namespace {

std::atomic<int> output_failure = 0;  // errno of the first failure to write standard output

void note(std::FILE* stream, bool written) noexcept {
  int none = 0;
  if (!written && stream == stdout) output_failure.compare_exchange_strong(none, errno);
}

}  // namespace

void hold_standard_streams() {
  // Those for output cannot be written to, like closed ones.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // takes the lowest number
}

void prepare_standard_streams() {
  hold_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);
}

void put(std::FILE* to, std::string_view text) noexcept {
  note(to, std::fwrite(text.data(), 1, text.size(), to) == text.size());
}

void flush(std::FILE* to) noexcept { note(to, std::fflush(to) == 0); }

int end_output(int code, bool is_log) {
  flush(stdout);
  const int failure = output_failure;
  if (failure == 0) return code;
  tell(stderr, "standard output: cannot write: {}\n", std::strerror(failure));
  return is_log ? code : static_cast<int>(ExitCode::machine);
}

}  // namespace pulvis
