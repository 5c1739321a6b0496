// Runs many scenes as separate processes, several at once; finished runs are kept, interrupted ones are resumed.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "cli/campaigns/study/study_results.hpp"

namespace pulvis {

struct StudyTimes {
  double wall_seconds = 0;
  int jobs = 1, threads = 1;
};

struct RunnerOptions {
  int jobs = 0;        // concurrent runs; 0: as many as the processors allow
  int threads = 0;     // per run; 0: one, or the processors shared among few runs
  bool fresh = false;  // run everything again
  std::map<std::string, std::string> elsewhere = {};  // run by others, and by whom: not started
  bool gather = false;                                // start no runs
};

void make_folder(const std::filesystem::path& folder);

class StudyRunner {
 public:
  // Everything that can be refused is refused here, before the first run. `runs` must outlive this; each has a folder
  // of its name in `folder`.
  StudyRunner(const RunnerOptions& options, const std::vector<StudyRun>& runs,
              std::filesystem::path folder);
  ~StudyRunner();
  StudyRunner(const StudyRunner&) = delete;
  StudyRunner& operator=(const StudyRunner&) = delete;

  void go();                         // until all have ended, or an interrupt
  std::vector<StudyResult>& read();  // in the order of the runs, with what their folders hold
  std::size_t tell_bad() const;      // names the failed runs; returns their number
  std::size_t elsewhere() const;     // number of unfinished runs that others do
  std::vector<std::string> waiting() const;  // names of the runs that go() would start
  const StudyTimes& times() const;
  std::size_t done() const;
  std::size_t to_do() const;
  bool has_come_further() const;  // something was finished, or can be resumed from where it stopped

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pulvis
