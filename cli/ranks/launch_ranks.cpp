#include "cli/ranks/launch_ranks.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <sstream>
#include <string_view>
#include <thread>

#include "cli/shell_word.hpp"
#include "cli/tell.hpp"
#include "engine/files/checkpoint.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

constexpr int wish_to_stop =
    SIGUSR1;  // forwarded by mpirun; at SIGTERM it kills the ranks a second later
constexpr rlim_t largest_file = 5 << 20;  // of mpirun: 4 MB with Open MPI 4.1
constexpr int killed = 128;  // mpirun's exit code: this plus the signal that killed a rank

fs::path mpirun() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    fs::path file = fs::path(folder.empty() ? "." : folder) / "mpirun";
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  throw OutputError("mpirun", "start it", "it is not on PATH: install the package openmpi-bin");
}

std::vector<std::string> command_of(const RankLaunch& launch) {
  // More ranks than cores are the user's choice. Threads of a rank run anywhere: bound to a core, mpirun's default,
  // they would share one core.
  std::vector<std::string> words{mpirun(),          "-np",       std::to_string(launch.ranks),
                                 "--oversubscribe", "--bind-to", "none",
                                 "--stdin",         "none",      "--quiet"};
  if (geteuid() == 0) words.push_back("--allow-run-as-root");
  words.push_back(launch.program);
  words.insert(words.end(), launch.words.begin(), launch.words.end());
  return words;
}

// Blocks signals that this process waits for instead of being interrupted by them.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGCHLD}) sigaddset(&held_, signal);
    sigprocmask(SIG_BLOCK, &held_, &before_);
  }
  ~SignalsHeld() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

  // The next one; 0 if none comes within `most`.
  int next(const timespec& most) const {
    const int signal = sigtimedwait(&held_, nullptr, &most);
    return std::max(signal, 0);
  }
  const sigset_t& before() const { return before_; }

 private:
  sigset_t held_{}, before_{};
};

// After fork() only async-signal-safe calls. Own process group: a terminal's ^C reaches only this process.
[[noreturn]] void become(char* const* words, const sigset_t& mask, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, wish_to_stop);
  if (getppid() != parent) _exit(1);  // the parent died in between
  sigprocmask(SIG_SETMASK, &mask, nullptr);
  execv(words[0], words);
  _exit(127);
}

pid_t start(const std::vector<std::string>& command, const SignalsHeld& signals) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const pid_t parent = getpid(), child = fork();
  if (child == 0) become(words.data(), signals.before(), parent);
  if (child < 0) throw OutputError(command[0], "start it", std::strerror(errno));
  return child;
}

// As Open MPI chooses it; the standard library's choice must exist.
fs::path temporary_folder() {
  for (const char* variable : {"TMPDIR", "TEMP", "TMP"})
    if (const char* folder = std::getenv(variable); folder != nullptr && *folder != '\0')
      return folder;
  return "/tmp";
}

// The state of a run's folder: which checkpoint is the last one, and when its files were written.
struct Written {
  std::vector<fs::path> checkpoints;
  fs::file_time_type checkpoint, results, summary;  // the earliest possible time if there is none

  explicit Written(const fs::path& folder)
      : checkpoints(checkpoints_in(folder)),
        checkpoint(checkpoints.empty() ? fs::file_time_type::min() : time_of(checkpoints.front())),
        results(time_of(folder / "run.h5")),
        summary(time_of(folder / "summary.json")) {}
  bool operator==(const Written&) const = default;

 private:
  static fs::file_time_type time_of(const fs::path& file) {
    std::error_code missing;
    const fs::file_time_type time = fs::last_write_time(file, missing);
    return missing ? fs::file_time_type::min() : time;
  }
};

void tell_how_to_go_on(const fs::path& folder, const Written& before) {
  if (const Written now(folder); now == before)
    tell(stderr,
         "pulvis: nothing was written; once the cause is fixed, give the same command again\n");
  else if (now.checkpoints.empty())
    tell(stderr,
         "pulvis: there is no checkpoint to continue from; once the cause is fixed, run it again, "
         "with --overwrite\n");
  else
    tell(stderr, "pulvis: once the cause is fixed, continue with: pulvis resume {}\n",
         shell_word(folder.string()));
}

bool is_own(int code) {
  constexpr std::array codes{ExitCode::done, ExitCode::usage, ExitCode::run_failed,
                             ExitCode::machine, ExitCode::interrupted};
  return std::ranges::find(codes, static_cast<ExitCode>(code)) != codes.end();
}

// Ranks notice within seconds that there is no mpirun any more; until then they write into the folder.
bool end_without_mpirun(const fs::path& folder) {
  constexpr int looks = 100;
  for (int i = 0; i < looks && is_locked(folder); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  return !is_locked(folder);
}

ExitCode end_of(int status, bool asked, const fs::path& folder, const Written& before) {
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  // The first rank tells it too, unless another one failed.
  if (code == static_cast<int>(ExitCode::machine)) tell_how_to_go_on(folder, before);
  if (is_own(code)) return static_cast<ExitCode>(code);
  // SIGTERM to mpirun as well: it ends with another code than the ranks, which have told where they stopped.
  if (asked && end_without_mpirun(folder))
    if (const Written now(folder);
        now.summary != before.summary && now.checkpoint != before.checkpoint)
      return ExitCode::interrupted;
  if (asked && (WIFSIGNALED(status) ||
                code == killed + wish_to_stop)) {  // before the ranks could react to it
    tell(stderr, "pulvis: interrupted before all ranks had started\n");
    return ExitCode::interrupted;
  }
  if (WIFSIGNALED(status)) {
    tell(stderr, "pulvis: mpirun was killed by signal {} ({})\n", WTERMSIG(status),
         strsignal(WTERMSIG(status)));
    if (!end_without_mpirun(folder))
      tell(stderr, "pulvis: its ranks still run: kill them before anything else\n");
  } else if (code > killed && code <= killed + SIGRTMAX)
    tell(stderr, "pulvis: a rank was killed by signal {} ({}), and the others were terminated\n",
         code - killed, strsignal(code - killed));
  else
    tell(stderr,
         "pulvis: the ranks did not start or did not finish: mpirun ended with exit code {}\n",
         code);
  tell_how_to_go_on(folder, before);
  return ExitCode::machine;
}

}  // namespace

void require_room_to_start(const fs::path& folder, std::uintmax_t bytes) {
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw OutputError(folder, "start the ranks",
                      fmt::format("mpirun needs a folder for temporary files there, {}: set TMPDIR "
                                  "to another folder",
                                  std::strerror(errno)));
  rlimit most{};
  if (getrlimit(RLIMIT_FSIZE, &most) == 0 && most.rlim_cur < largest_file)
    throw OutputError(folder, "start the ranks",
                      fmt::format("mpirun needs files of {} MB there, the limit of this process is "
                                  "{} kB (ulimit -f)",
                                  largest_file >> 20, most.rlim_cur >> 10));
  std::error_code error;
  const fs::space_info room = fs::space(folder, error);
  if (error || room.available >= bytes) return;
  throw OutputError(
      folder, "start the ranks",
      fmt::format("mpirun needs {} MB there, {} are free: set TMPDIR to another folder",
                  bytes >> 20, room.available >> 20));
}

ExitCode launch_ranks(const RankLaunch& launch) {
  // Three ranks used 4 MB with Open MPI 4.1, and did not start with less.
  require_room_to_start(temporary_folder(), std::uintmax_t{32} << 20);
  const std::vector<std::string> command = command_of(launch);
  const Written before(launch.folder);
  const SignalsHeld signals;
  const pid_t child = start(command, signals);
  bool asked = false;
  // mpirun drops signals until the ranks have started, so they are repeated, ever less often.
  std::time_t patience = 1;  // s
  for (int status = 0;;) {
    const int signal = signals.next({patience, 0});
    if (signal == SIGCHLD) {
      if (waitpid(child, &status, WNOHANG) == child && !WIFSTOPPED(status))
        return end_of(status, asked, launch.folder, before);
    } else if (signal != 0) {
      asked = true;
      kill(child, wish_to_stop);
    } else if (asked) {
      kill(child, wish_to_stop);
      patience *= 2;
    }
  }
}

std::vector<std::string> without_ranks(const std::vector<std::string>& words) {
  constexpr std::string_view option = "--ranks";
  std::vector<std::string> others;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == option)
      ++i;
    else if (!words[i].starts_with(std::string(option) + '='))
      others.push_back(words[i]);
  }
  return others;
}

fs::path own_program() { return fs::read_symlink("/proc/self/exe"); }

}  // namespace pulvis
