#include "cli/live/live_view.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "cli/tell.hpp"

namespace pulvis {

LiveView::LiveView(const std::filesystem::path& folder, int port) {
  std::array<int, 2> ends{-1, -1};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    tell(stderr, "warning: no live view: {}\n", std::strerror(errno));
    return;
  }
  alive_ = FileDescriptor(ends[1]);
  const FileDescriptor input(ends[0]);
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.get(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  std::vector<std::string> words{"pulvis",   "watch",  std::filesystem::absolute(folder).string(),
                                 "--of-run", "--port", std::to_string(port)};
  if (port == 0) words.resize(words.size() - 2);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error =
      posix_spawn(&child_, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == 0) return;
  child_ = -1;
  tell(stderr, "warning: no live view: {}\n", std::strerror(error));
}

LiveView::~LiveView() {
  alive_ = FileDescriptor();
  if (child_ < 0) return;
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) continue;
}

}  // namespace pulvis
