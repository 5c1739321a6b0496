#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "cli/tell.hpp"

namespace pulvis {

Progress::Progress(double end, std::int64_t elements, bool shown, const Before& before)
    : end_(end),
      elements_(elements),
      is_shown_(shown),
      before_(before),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Time::now()),
      shown_(start_) {}

Progress::Progress(double end, std::int64_t elements, bool shown)
    : Progress(end, elements, shown, Before()) {}

double Progress::seconds() const {
  return before_.seconds + std::chrono::duration<double>(Time::now() - start_).count();
}

double Progress::left(double wall, double time) {
  marks_.push_back({wall, time});
  const double oldest = before_.seconds + 2.0 / 3 * (wall - before_.seconds);
  while (marks_.size() > 2 && marks_[1].wall < oldest) marks_.pop_front();
  const Mark& from = marks_.front();
  if (marks_.size() < 2 || !(time > from.time)) return wall * (end_ - time) / time;
  return (end_ - time) * (wall - from.wall) / (time - from.time);
}

void Progress::show(double time, std::int64_t step) {
  if (!is_shown_) return;
  const auto now = Time::now();
  if (now - shown_ < (terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(10)))
    return;
  shown_ = now;
  const double wall = seconds();
  const double rate = static_cast<double>(step - before_.step) / (wall - before_.seconds);
  const std::string line = fmt::format(
      "{:5.1f}%  t = {:.4g} s of {:.4g} s, step {}, {:.0f} steps/s, {:.1f} M element-updates/s, "
      "{:.0f} s left",
      100 * time / end_, time, end_, step, rate, rate * static_cast<double>(elements_) * 1e-6,
      time > 0 ? left(wall, time) : 0);
  put(stderr, fmt::format("{}{}{}", terminal_ ? "\r\033[K" : "", line, terminal_ ? "" : "\n"));
  flush(stderr);
  line_open_ = terminal_;
}

void Progress::finish() {
  if (line_open_) put(stderr, "\n");
  line_open_ = false;
}

}  // namespace pulvis
