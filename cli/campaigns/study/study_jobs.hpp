// Runs commands as child processes, several at once.
//
// Each run of a study is a separate process: one that crashes, or uses all memory, does not affect the
// others; each has its log; no run can interfere with another. Children end with their parent,
// however it ends (PR_SET_PDEATHSIG), so that a killed study leaves nothing running.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pulvis {

struct Job {
  std::vector<std::string> arguments;  // for this program, without its name
  std::filesystem::path log;           // exists already; output is appended
};

struct JobEnd {
  int code = -1;   // exit code; -1: a signal ended it
  int signal = 0;  // which one
  double seconds = 0;
};

// Callbacks during the runs; `job` is an index into the list.
struct JobEvents {
  std::function<void(std::size_t job)> starting;  // just before
  std::function<void(std::size_t job, const JobEnd& end)> ended;
  std::function<void()> waiting;  // several times per second
  std::function<bool()>
      stopping;  // true: no new jobs are started, and running ones are asked to stop (SIGINT)
};

// At most `maximum` at once, in list order. Returns when all have ended or, once asked to stop,
// all that were started. Throws OutputError if a process cannot be created.
void run_jobs(const std::vector<Job>& jobs, int maximum, const JobEvents& events);

}  // namespace pulvis
