#include "cli/campaigns/study/study_jobs.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

#include "engine/files/output_error.hpp"

namespace pulvis {
namespace {

using Time = std::chrono::steady_clock;

constexpr const char* this_program = "/proc/self/exe";
constexpr auto between_looks = std::chrono::milliseconds(20);

struct Running {
  std::size_t job;
  pid_t process;
  Time::time_point since;
};

// After fork() only async-signal-safe calls are allowed: everything is prepared before.
[[noreturn]] void become(char* const* arguments, int log, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // the parent died in between
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execv(this_program, arguments);
  _exit(127);
}

pid_t start(const Job& job) {
  std::vector<char*> arguments{const_cast<char*>("pulvis")};
  for (const std::string& word : job.arguments)
    arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int log = open(job.log.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (log < 0) throw OutputError(job.log, "write the log", std::strerror(errno));
  const pid_t parent = getpid(), child = fork();
  if (child == 0) become(arguments.data(), log, parent);
  const int failure = errno;
  close(log);
  if (child < 0) throw OutputError(job.log.parent_path(), "start the run", std::strerror(failure));
  return child;
}

// True when the child has ended.
bool ended(const Running& running, JobEnd& end) {
  int status = 0;
  if (waitpid(running.process, &status, WNOHANG) != running.process) return false;
  end.seconds = std::chrono::duration<double>(Time::now() - running.since).count();
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return true;
}

// On any error here, all children are still waited for.
struct Children {
  std::vector<Running> running;
  ~Children() {
    for (const Running& child : running) kill(child.process, SIGTERM);
    for (const Running& child : running) waitpid(child.process, nullptr, 0);
  }
  void collect(const JobEvents& events) {
    for (std::size_t i = 0; i < running.size();) {
      JobEnd end;
      if (!ended(running[i], end)) {
        ++i;
        continue;
      }
      const std::size_t job = running[i].job;
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      events.ended(job, end);
    }
  }
};

}  // namespace

void run_jobs(const std::vector<Job>& jobs, int maximum, const JobEvents& events) {
  Children children;
  std::size_t next = 0;
  bool told = false;
  while (next < jobs.size() || !children.running.empty()) {
    const bool stopping = events.stopping();
    if (stopping && !told)
      for (const Running& child : children.running) kill(child.process, SIGINT);
    told = stopping;
    if (stopping) next = jobs.size();
    while (next < jobs.size() && children.running.size() < static_cast<std::size_t>(maximum)) {
      events.starting(next);
      children.running.push_back({next, start(jobs[next]), Time::now()});
      ++next;
    }
    children.collect(events);
    events.waiting();
    if (!children.running.empty()) std::this_thread::sleep_for(between_looks);
  }
}

}  // namespace pulvis
