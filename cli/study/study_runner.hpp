// Runs many scenes as processes of their own, several at once; what is finished is kept, what was broken off goes on.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "cli/study/study_results.hpp"

namespace pulvis {

struct StudyTimes {
  double wall_seconds = 0;
  int jobs = 1, threads = 1;
};

struct RunnerOptions {
  int jobs = 0;        // runs at once; 0: as many as the processors are enough for
  int threads = 0;     // of each run; 0: one, or the processors shared out among few runs
  bool fresh = false;  // run everything again
  std::map<std::string, std::string> elsewhere = {};  // runs that others do, and who: not started
  bool gather = false;                                // start none
};

void make_folder(const std::filesystem::path& folder);

class StudyRunner {
 public:
  // Everything that can be refused is refused here, before the first run. `runs` outlive this; each has a folder of its
  // name in `folder`.
  StudyRunner(const RunnerOptions& options, const std::vector<StudyRun>& runs,
              std::filesystem::path folder);
  ~StudyRunner();
  StudyRunner(const StudyRunner&) = delete;
  StudyRunner& operator=(const StudyRunner&) = delete;

  void go();                         // until all have ended, or an interrupt
  std::vector<StudyResult>& read();  // in the order of the runs, with what their folders tell
  std::size_t tell_bad() const;      // names those that went bad; how many
  std::size_t elsewhere() const;     // how many are not finished, and not for this to run
  std::vector<std::string> waiting() const;  // names of those that go() would run
  const StudyTimes& times() const;
  std::size_t done() const;
  std::size_t to_do() const;
  bool has_come_further() const;  // something was finished, or can go on from where it stopped

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pulvis
