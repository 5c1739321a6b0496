#include "cli/live/live_data.hpp"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "engine/files/xxh3.hpp"

namespace pulvis {
namespace {

constexpr std::size_t kept_versions = 8;  // whose sections a page may still have

}  // namespace

void LiveData::set_state(const std::string& json, bool is_last) {
  const std::lock_guard lock(mutex_);
  state_ = json;
  if (is_last && !is_last_) changed_.notify_all();
  is_last_ = is_last;
}

void LiveData::set_report(ReportData report) {
  Hashes hashes;
  for (const ReportSection& section : report.sections)
    hashes[section.name] = xxh3(std::as_bytes(std::span(section.text)));
  const std::lock_guard lock(mutex_);
  report_ = std::move(report);
  hashes_[++version_] = std::move(hashes);
  if (hashes_.size() > kept_versions) hashes_.erase(hashes_.begin());
  is_told_ = false;
  changed_.notify_all();
}

LiveData::Time::duration LiveData::since_last_question() const {
  const std::lock_guard lock(mutex_);
  return asked_ == Time::time_point::min() ? Time::duration::max() : Time::now() - asked_;
}

bool LiveData::is_told() const {
  const std::lock_guard lock(mutex_);
  return is_told_;
}

std::string LiveData::state(std::int64_t known) {
  std::unique_lock lock(mutex_);
  asked_ = Time::now();
  changed_.wait_for(lock, std::chrono::seconds(1),
                    [&] { return version_ != known || (is_last_ && !is_told_); });
  asked_ = Time::now();
  is_told_ = is_last_ && version_ == known;
  return fmt::format(R"({{"version":{},"last":{},"state":{}}})", version_, is_last_, state_);
}

std::string LiveData::report(std::int64_t known) {
  const std::lock_guard lock(mutex_);
  asked_ = Time::now();
  const auto before = hashes_.find(known);
  std::string json = fmt::format(R"({{"version":{},"head":{},"sections":{{)", version_,
                                 report_.head.empty() ? "null" : report_.head);
  bool is_first = true;
  for (const ReportSection& section : report_.sections) {
    json += fmt::format("{}\"{}\":", is_first ? "" : ",", section.name);
    is_first = false;
    const auto is_known = [&] {
      const auto there = before->second.find(section.name);
      return there != before->second.end() && there->second == hashes_[version_][section.name];
    };
    if (before != hashes_.end() && is_known())
      json += "null";
    else
      (json += '"').append(section.text) += '"';
  }
  return json + "}}";
}

}  // namespace pulvis
