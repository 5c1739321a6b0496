#include "cli/campaigns/study/study_runner.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>

#include "cli/campaigns/study/study_jobs.hpp"
#include "cli/checkpoints.hpp"
#include "cli/exit_code.hpp"
#include "cli/interrupt.hpp"
#include "cli/report/report.hpp"
#include "cli/shell_word.hpp"
#include "cli/tell.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/run_folder.hpp"
#include "scenes/language/counted.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using Time = std::chrono::steady_clock;

// Number of concurrent runs and threads of each, within the processors.
StudyTimes shares(const RunnerOptions& options, std::size_t runs) {
  const int cores = oneapi::tbb::info::default_concurrency();
  const int wanted = std::max(1, static_cast<int>(std::min<std::size_t>(runs, 1024)));
  StudyTimes times;
  times.threads = options.threads > 0 ? options.threads : 0;
  times.jobs = options.jobs > 0 ? options.jobs : std::max(1, cores / std::max(1, times.threads));
  times.jobs = std::min(times.jobs, wanted);
  if (times.threads == 0) times.threads = std::max(1, cores / times.jobs);
  return times;
}

std::string last_line(const fs::path& log) {
  std::ifstream stream(log);
  std::string line, last;
  while (std::getline(stream, line))
    if (!line.empty()) last = line;
  return last;
}

// What the log of a failed run says about it.
std::string failure_of(const JobEnd& end, const fs::path& log) {
  if (end.signal != 0)
    return fmt::format("crashed: signal {} ({})", end.signal, strsignal(end.signal));
  if (end.code == 0 || end.code == static_cast<int>(ExitCode::run_failed))
    return "";  // summary.json says
  if (end.code == static_cast<int>(ExitCode::interrupted)) return "interrupted";
  return fmt::format("exit code {}: {}", end.code, last_line(log));
}

// Who has an unfinished run, if not this study.
std::string who_has(const StudyResult& result, const RunnerOptions& options) {
  const auto known = options.elsewhere.find(result.run->name);
  if (known != options.elsewhere.end()) return known->second;
  return options.gather ? "not finished" : "";
}

void require_own_run(const fs::path& folder) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(folder, ignored);
  if (fs::exists(status) && !fs::is_directory(folder, ignored))
    throw ForeignFile(folder, "make the run's folder", "there is a file of that name");
  require_own_files(folder);
  require_own_or_none(folder / "log.txt", role::study);
}

// Its first line names the command; the run's output follows.
void begin_log(const fs::path& log, const Job& job) {
  std::string line = "pulvis";
  for (const std::string& word : job.arguments) line += " " + shell_word(word);
  write_own(log, role::study, line + "\n", Extent::start);
}

}  // namespace

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, "make the folder", error.message());
}

class StudyRunner::Parts {
 public:
  Parts(const RunnerOptions& options, const std::vector<StudyRun>& runs, fs::path folder)
      : folder_(std::move(folder)),
        elsewhere_(options.elsewhere),
        terminal_(isatty(STDERR_FILENO) != 0) {
    for (const StudyRun& run : runs) {
      StudyResult result;
      result.run = &run;
      result.folder = folder_ / run.name;
      result.kept = !options.fresh && state_of(result.folder, run.hash) == RunState::finished;
      if (!result.kept) result.elsewhere = who_has(result, options);
      const bool is_waiting = !result.kept && result.elsewhere.empty();
      result.resumed = is_waiting && !options.fresh && can_go_on(result.folder, run.hash);
      if (is_waiting) require_own_run(result.folder);
      if (result.kept) require_own_or_none(result.folder / "report.html", role::run);
      if (is_waiting) waiting_.push_back(results_.size());
      results_.push_back(std::move(result));
    }
    times_ = shares(options, waiting_.size());
  }

  void go() {
    const auto kept = std::ranges::count(results_, true, &StudyResult::kept);
    tell("{}: {} to do, {} finished before; {} at once, {} each\n", counted(results_.size(), "run"),
         waiting_.size(), kept, times_.jobs, counted(times_.threads, "thread"));
    tell_elsewhere();
    const auto resumed = std::ranges::count(results_, true, &StudyResult::resumed);
    if (resumed > 0) tell("interrupted before, resumed from their checkpoints: {}\n", resumed);
    flush(stdout);
    std::vector<Job> jobs;
    for (const std::size_t i : waiting_) jobs.push_back(job_of(results_[i]));
    run_jobs(jobs, times_.jobs,
             {[&](std::size_t job) { begin(job); },
              [&](std::size_t job, const JobEnd& end) { ended(job, end); }, [&] { show_state(); },
              [] { return interrupted(); }});
    clear_state();
    times_.wall_seconds = seconds();
  }

  std::vector<StudyResult>& read() {
    for (StudyResult& result : results_) {
      read_result(result);
      // A run that was killed after writing its summary but before its report.
      if (result.kept && !elsewhere_.contains(result.run->name) &&
          !fs::exists(result.folder / "report.html") && fs::exists(result.folder / "run.h5"))
        write_report(result.folder);
    }
    return results_;
  }

  std::size_t tell_bad() const {
    std::size_t bad = 0;
    for (const StudyResult& result : results_) {
      if (result.failure.empty() || !result.elsewhere.empty()) continue;
      tell(stderr, "pulvis: {}: {}\n", result.run->name, result.failure);
      ++bad;
    }
    return bad;
  }

  const StudyTimes& times() const { return times_; }

  std::size_t elsewhere() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        results_, [](const StudyResult& result) { return !result.elsewhere.empty(); }));
  }

  void tell_elsewhere() const {
    constexpr std::size_t most_named = 3;
    std::size_t told = 0;
    for (const StudyResult& result : results_)
      if (!result.elsewhere.empty() && told++ < most_named)
        tell("not started here: {}: {}\n", result.run->name, result.elsewhere);
    if (told > most_named) tell("... and {} more\n", told - most_named);
  }

  std::vector<std::string> waiting() const {
    std::vector<std::string> names;
    for (const std::size_t i : waiting_) names.push_back(results_[i].run->name);
    return names;
  }

  bool has_come_further() const {
    return done_ > 0 || std::ranges::any_of(waiting_, [&](std::size_t i) {
             return can_go_on(results_[i].folder, results_[i].run->hash);
           });
  }

  std::size_t done() const { return done_; }
  std::size_t to_do() const { return waiting_.size(); }

 private:
  Job job_of(const StudyResult& result) const {
    const fs::path log = result.folder / "log.txt";
    const std::string threads = std::to_string(times_.threads);
    if (result.resumed) return {{"resume", result.folder.string(), "--threads", threads}, log};
    Job job{{"run", result.run->file.string(), "-o", result.folder.string(), "--overwrite",
             "--threads", threads},
            log};
    for (const std::string& change : result.run->overrides)
      job.arguments.insert(job.arguments.end(), {"--set", change});
    return job;
  }

  // The old summary.json is removed first: with it a half-finished run would look finished.
  void begin(std::size_t job) {
    const fs::path& folder = results_[waiting_[job]].folder;
    make_folder(folder);
    remove_own(folder / "summary.json", role::run);
    begin_log(folder / "log.txt", job_of(results_[waiting_[job]]));
    running_.push_back(job);
  }

  void ended(std::size_t job, const JobEnd& end) {
    std::erase(running_, job);
    StudyResult& result = results_[waiting_[job]];
    result.code = end.code;
    result.failure = failure_of(end, result.folder / "log.txt");
    if (interrupted()) return;
    done_ += 1;
    StudyResult told = result;
    read_result(told);
    clear_state();
    tell("[{}/{}] {}: {} in {:.1f} s\n", done_, waiting_.size(), result.run->name,
         told.failure.empty() ? "done" : "BAD: " + told.failure, end.seconds);
    flush(stdout);
  }

  double seconds() const { return std::chrono::duration<double>(Time::now() - start_).count(); }

  void show_state() {
    if (!terminal_ || Time::now() - shown_ < std::chrono::milliseconds(500)) return;
    shown_ = Time::now();
    std::string line = fmt::format("{} of {} done, running:", done_, waiting_.size());
    for (const std::size_t job : running_) line += " " + results_[waiting_[job]].run->name;
    if (done_ > 0)
      line +=
          fmt::format("; about {:.0f} s left", seconds() / static_cast<double>(done_) *
                                                   static_cast<double>(waiting_.size() - done_));
    constexpr std::size_t widest = 110;
    put(stderr, fmt::format("\r\033[K{}", printable(line.substr(0, widest))));
    flush(stderr);
    open_ = true;
  }

  void clear_state() {
    if (open_) put(stderr, "\r\033[K");
    open_ = false;
  }

  fs::path folder_;
  std::map<std::string, std::string> elsewhere_;
  bool terminal_, open_ = false;
  std::vector<StudyResult> results_;
  std::vector<std::size_t> waiting_;  // indices in results_, of those to run
  std::vector<std::size_t> running_;  // indices in waiting_
  std::size_t done_ = 0;
  StudyTimes times_;
  Time::time_point start_ = Time::now(), shown_ = start_;
};

StudyRunner::StudyRunner(const RunnerOptions& options, const std::vector<StudyRun>& runs,
                         fs::path folder)
    : parts_(std::make_unique<Parts>(options, runs, std::move(folder))) {}
StudyRunner::~StudyRunner() = default;

void StudyRunner::go() { parts_->go(); }
std::vector<StudyResult>& StudyRunner::read() { return parts_->read(); }
std::size_t StudyRunner::tell_bad() const { return parts_->tell_bad(); }
const StudyTimes& StudyRunner::times() const { return parts_->times(); }
std::size_t StudyRunner::elsewhere() const { return parts_->elsewhere(); }
std::vector<std::string> StudyRunner::waiting() const { return parts_->waiting(); }
bool StudyRunner::has_come_further() const { return parts_->has_come_further(); }
std::size_t StudyRunner::done() const { return parts_->done(); }
std::size_t StudyRunner::to_do() const { return parts_->to_do(); }

}  // namespace pulvis
