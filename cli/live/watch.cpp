#include "cli/live/watch.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <thread>

#include "cli/interrupt.hpp"
#include "cli/live/live_server.hpp"
#include "cli/live/run_watch.hpp"
#include "cli/report/report.hpp"
#include "cli/tell.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/processor_time.hpp"

namespace pulvis {
namespace {

using Time = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto between_looks = 250ms;
constexpr auto page_is_open = 10s;    // since its last question
constexpr auto farewell = 15s;        // that pages have to fetch the end of a run
constexpr auto for_other_pages = 1s;  // after the first one knows the end
// After reading the results it waits for this many times the processor time that reading took.
constexpr int share_of_reading = 4;

// The run's process holds the other end of a pipe for as long as it lives.
bool has_ended(const WatchOptions& options) {
  if (!options.of_run) return false;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return poll(&input, 1, 0) > 0;
}

class Watch {
 public:
  explicit Watch(const WatchOptions& options)
      : options_(options), run_(options.folder), server_(data_, options.port) {}

  const std::string& address() const { return server_.address(); }

  void go() {
    while (!interrupted()) {
      const bool ended = has_ended(options_);  // before the look: it then sees all
      const RunState state = run_.look();
      const bool is_read = read(ended);
      data_.set_state(json_of(state), ended && is_read);
      if (ended && is_over()) return;
      std::this_thread::sleep_for(between_looks);
    }
  }

 private:
  // Whether the pages can have everything. Nothing is read for nobody.
  bool read(bool at_once) {
    if (!run_.has_news()) return true;
    if (data_.since_last_question() > page_is_open) return !at_once;
    if (!at_once && Time::now() < next_) return false;
    const double begin = thread_seconds();
    auto report = run_.read();
    next_ = Time::now() +
            std::chrono::duration_cast<Time::duration>(
                share_of_reading * std::chrono::duration<double>(thread_seconds() - begin));
    if (report) data_.set_report(std::move(*report));
    return report.has_value();
  }

  // After the run's process has ended.
  bool is_over() {
    if (!over_) over_ = Time::now() + farewell;
    const Time::time_point at = Time::now();
    if (data_.is_told() && !told_) told_ = at;
    return data_.since_last_question() > page_is_open || at > *over_ ||
           (told_ && at > *told_ + for_other_pages);
  }

  WatchOptions options_;
  RunWatch run_;
  LiveData data_;
  LiveServer server_;
  Time::time_point next_{};
  std::optional<Time::time_point> over_, told_;
};

void require_run_or_start(const std::filesystem::path& folder) {
  if (!is_locked(folder)) require_run(folder, "watch");
}

}  // namespace

ExitCode watch_run(const WatchOptions& options) {
  constexpr int yields_to_the_run = 5;
  setpriority(PRIO_PROCESS, 0, yields_to_the_run);
  require_run_or_start(options.folder);
  take_interrupts();
  if (options.of_run) {  // the run reacts to them
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, SIG_IGN);
    std::signal(SIGUSR1, SIG_IGN);
  }
  try {
    Watch watch(options);
    if (options.of_run)
      tell(stderr, "live view: {}\n", watch.address());
    else
      tell(
          "{}\nOpen this address in a browser on this machine; Ctrl-C ends the view, not the "
          "run.\n",
          watch.address());
    flush(stdout);
    watch.go();
  } catch (const PortTaken& error) {
    tell(stderr, "{}{}\n", error.what(),
         options.of_run ? "; the run goes on without a live view" : "");
    return ExitCode::usage;
  }
  return ExitCode::done;
}

CLI::Option* add_port(CLI::App& command, int& port) {
  return command
      .add_option("--port", port, "port of the live view on this machine (default: any free one)")
      ->check(CLI::Range(1, 65535));
}

void add_watch(CLI::App& app, WatchOptions& options, ExitCode& code) {
  auto* command = app.add_subcommand(
      "watch", "show a run under way in the browser: picture, curves and time left, as they come");
  command->add_option("folder", options.folder, "results folder of a run")->required();
  add_port(*command, options.port);
  command->add_flag("--of-run", options.of_run)->group("");  // not in the help
  command->callback([&] { code = watch_run(options); });
}

}  // namespace pulvis
