#include "cli/slurm/captured.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "engine/files/file_descriptor.hpp"
#include "engine/files/output_error.hpp"

namespace pulvis {
namespace {

// Actions of the child before it executes the other program.
class SpawnActions {
 public:
  SpawnActions(int output, const std::filesystem::path& folder) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

std::vector<char*> environment_without(const std::vector<std::string>& hidden) {
  std::vector<char*> variables;
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (std::ranges::none_of(hidden, [&](const std::string& name) {
          return std::string_view(*variable).starts_with(name);
        }))
      variables.push_back(*variable);
  variables.push_back(nullptr);
  return variables;
}

pid_t spawn(const std::vector<std::string>& words, const SpawnActions& actions,
            const std::vector<std::string>& hidden) {
  std::vector<char*> arguments, variables = environment_without(hidden);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], actions.get(), nullptr, arguments.data(),
                                 variables.data());
  if (error == ENOENT) throw NoProgram();
  if (error != 0) throw OutputError(words[0], "start it", std::strerror(error));
  return child;
}

std::string all_of(int descriptor) {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t count = read(descriptor, part.data(), part.size());
    if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
  }
}

}  // namespace

Captured run_captured(const std::vector<std::string>& words, const std::filesystem::path& folder,
                      const std::vector<std::string>& hidden) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw OutputError(words[0], "start it", std::strerror(errno));
  const FileDescriptor out(ends[0]);
  pid_t child = 0;
  {
    const FileDescriptor in(ends[1]);
    child = spawn(words, SpawnActions(in.get(), folder), hidden);
  }
  Captured end;
  end.text = all_of(out.get());
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFEXITED(status)) end.code = WEXITSTATUS(status);
  return end;
}

}  // namespace pulvis
