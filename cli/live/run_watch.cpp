#include "cli/live/run_watch.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/files/hdf5.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/files/shared_file.hpp"

namespace pulvis {
namespace {

using Phase = RunState::Phase;

constexpr double ns = 1e-9;
constexpr double patience =
    120;  // s without news, before a run that cannot be asked is called silent

std::int64_t written_at(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return 0;
  return status.st_mtim.tv_sec * std::int64_t{1'000'000'000} + status.st_mtim.tv_nsec;
}

double now() {
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  return static_cast<double>(time.tv_sec) + ns * static_cast<double>(time.tv_nsec);
}

const char* name_of(Phase phase) {
  switch (phase) {
    case Phase::before:
      return "before";
    case Phase::running:
      return "running";
    case Phase::silent:
      return "silent";
    case Phase::gone:
      return "gone";
    case Phase::ended:
      return "ended";
    case Phase::missing:
      return "missing";
  }
  return "";
}

}  // namespace

std::string json_of(const RunState& state) {
  nlohmann::ordered_json json{{"phase", name_of(state.phase)},
                              {"outcome", state.outcome},
                              {"time", state.time},
                              {"end", state.end},
                              {"quiet", state.quiet}};
  json["left"] = state.seconds_left ? nlohmann::ordered_json(*state.seconds_left) : nullptr;
  if (state.limits)
    json["limits"] = {{"energy_balance", state.limits->energy_balance},
                      {"penetration", state.limits->penetration}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

RunWatch::RunWatch(std::filesystem::path folder)
    : folder_(std::move(folder)), has_locks_(has_one_view(folder_)) {
  state_.end = std::numeric_limits<double>::quiet_NaN();
}

RunWatch::Stamp RunWatch::stamp() const {
  Stamp stamp{.summary = written_at(folder_ / "summary.json")};
  struct stat status {};
  if (stat((folder_ / "run.h5").c_str(), &status) != 0) return stamp;
  stamp.inode = status.st_ino;
  stamp.size = static_cast<std::uint64_t>(status.st_size);
  stamp.results = written_at(folder_ / "run.h5");
  return stamp;
}

RunState RunWatch::look() {
  const Stamp before = seen_;
  seen_ = stamp();
  if (seen_.inode != before.inode) {  // another run in the same folder, or the first look
    forecast_.reset();
    marks_.clear();
  }
  if (seen_.inode != 0 && progress_of_ != seen_) {
    try {
      read_progress();
      progress_of_ = seen_;
    } catch (const OutputError&) {  // it is just being written: the next look reads it
    }
  }
  const double at = now();
  const std::int64_t news = std::max(
      {seen_.results, seen_.summary, written_at(folder_ / "history.csv"), written_at(folder_)});
  state_.quiet = std::max(0.0, at - ns * static_cast<double>(news));
  state_.phase = phase_of(state_);
  state_.seconds_left.reset();
  if (const double left = seconds_left(at); std::isfinite(left) && state_.phase == Phase::running)
    state_.seconds_left = left;
  return state_;
}

RunState::Phase RunWatch::phase_of(const RunState& state) const {
  const bool runs = is_locked(folder_);
  if (seen_.inode == 0) return runs ? Phase::before : Phase::missing;
  if (!state.outcome.empty()) return Phase::ended;
  if (runs) return Phase::running;
  if (has_locks_) return Phase::gone;
  double longest = 0;  // between two frames
  for (std::size_t i = 1; i < marks_.size(); ++i)
    longest = std::max(longest, marks_[i].wall - marks_[i - 1].wall);
  return state.quiet < std::max(patience, 5 * longest) ? Phase::running : Phase::silent;
}

void RunWatch::read_progress() {
  const hdf5::File file = hdf5::File::open(folder_ / "run.h5");
  const std::vector<double> times = file.read_doubles("/history/time");
  const char* const density = "/history/relative_density";
  const std::vector<double> densities =
      file.contains(density) ? file.read_doubles(density) : std::vector<double>();
  if (!forecast_) forecast_.emplace(folder_ / "scene.toml");
  state_.outcome =
      file.has_attribute("/", "outcome") ? file.text_attribute("/", "outcome") : std::string();
  state_.time = times.empty() ? 0 : times.back();
  state_.end = forecast_->end(times, densities);
  state_.limits = forecast_->limits();
  if (marks_.empty())
    marks_.push_back({ns * static_cast<double>(written_at(folder_ / "scene.toml")), 0});
  if (state_.time > marks_.back().time)
    marks_.push_back({ns * static_cast<double>(seen_.results), state_.time});
}

// As fast as in the last third, since steps get shorter and more expensive. The first mark is the time at which the scene
// was saved, which of a run that was resumed is long ago: it is left out as soon as there are others.
double RunWatch::seconds_left(double at) const {
  constexpr std::size_t few = 2;
  if (marks_.size() < 2 || !std::isfinite(state_.end)) return std::nan("");
  const Mark& to = marks_.back();
  std::size_t from = marks_.size() > few + 1 ? 1 : 0;
  const double oldest = marks_[from].wall + 2.0 / 3 * (to.wall - marks_[from].wall);
  while (from + 2 < marks_.size() && marks_[from + 1].wall < oldest) ++from;
  const double rate = (to.time - marks_[from].time) / (to.wall - marks_[from].wall);
  return std::max(0.0, (state_.end - to.time) / rate - (at - to.wall));
}

std::optional<ReportData> RunWatch::read() {
  const Stamp before = stamp();
  if (before.inode == 0) return {};
  try {
    std::optional<ReportData> data(read_report_data(folder_));
    read_ = before;
    return data;
  } catch (const OutputError&) {
    return {};
  }
}

}  // namespace pulvis
