// Runs commands as child processes, several at once.
//
// Each run of a study is a process of its own: one that crashes, or takes all memory, costs none of the
// others; each has its log; and nothing of one can reach into another. Children end with their parent,
// however that ends (PR_SET_PDEATHSIG), so that a killed study leaves nothing running.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pulvis {

struct Job {
  std::vector<std::string> arguments;  // of this program, without its name
  std::filesystem::path log;           // is there; what it prints is added
};

struct JobEnd {
  int code = -1;   // exit code; -1: a signal ended it
  int signal = 0;  // which
  double seconds = 0;
};

// What is told as it happens; `job` is a position in the list.
struct JobEvents {
  std::function<void(std::size_t job)> starting;  // just before
  std::function<void(std::size_t job, const JobEnd& end)> ended;
  std::function<void()> waiting;  // several times a second
  std::function<bool()>
      stopping;  // true: nothing new is started, and what runs is asked to end (SIGINT)
};

// At most `maximum` at once, in the order of the list. Returns when all have ended or, once asked to stop,
// all that were started. Throws OutputError where a process cannot be made.
void run_jobs(const std::vector<Job>& jobs, int maximum, const JobEvents& events);

}  // namespace pulvis
