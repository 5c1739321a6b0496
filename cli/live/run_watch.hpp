// What a run's folder tells while the run is under way, in this process, in another one or on another machine: how far it
// is, and the data of its report. Only reads, and holds no file open between two looks.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/live/run_forecast.hpp"
#include "cli/report/report_data.hpp"

namespace pulvis {

struct RunState {
  // before: its results are not there yet; silent: nothing shows that it still runs, as its machine is another one;
  // gone: its process has ended without an outcome; missing: the folder holds no run any more.
  enum class Phase { before, running, silent, gone, ended, missing } phase = Phase::before;
  std::string outcome;                 // if it has ended: "done", "interrupted", "failed: ..."
  double time = 0;                     // of the last sample, s; of a lever: actions
  double end = 0;                      // expected; NaN: not known
  std::optional<double> seconds_left;  // wall time
  double quiet = 0;                    // s since it last wrote something
  std::optional<LimitSpec> limits;
};
std::string json_of(const RunState& state);

class RunWatch {
 public:
  explicit RunWatch(std::filesystem::path folder);

  // Looks at the folder: cheap as long as nothing has been written.
  RunState look();
  // Whether there is more than in the last `read`.
  bool has_news() const { return seen_ != read_; }
  // The report's data of the moment; nothing while they cannot be read, for example because they are just replaced.
  std::optional<ReportData> read();

 private:
  struct Stamp {  // what is known of the files without opening them
    std::uint64_t inode = 0, size = 0;
    std::int64_t results = 0, summary = 0;  // ns, when they were last written
    bool operator==(const Stamp&) const = default;
  };
  struct Mark {
    double wall = 0, time = 0;  // s since 1970; s or actions
  };
  Stamp stamp() const;
  void read_progress();
  double seconds_left(double now) const;
  RunState::Phase phase_of(const RunState& state) const;

  std::filesystem::path folder_;
  bool has_locks_;  // of all processes that may write into the folder
  Stamp seen_, read_, progress_of_;
  std::optional<RunForecast> forecast_;
  RunState state_;
  std::deque<Mark> marks_;
};

}  // namespace pulvis
