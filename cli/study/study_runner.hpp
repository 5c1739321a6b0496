// Runs many scenes as processes of their own, several at once; what is finished is kept, what was broken off goes on.
#pragma once

#include <filesystem>
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
  const StudyTimes& times() const;
  std::size_t done() const;
  std::size_t to_do() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pulvis
