// What the pages of a live view ask for: the state of the run, and the data of its report, of which each page gets only
// what has changed since its last question. Used by the thread that looks at the run and those that answer.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string>

#include "cli/report/report_data.hpp"

namespace pulvis {

class LiveData {
 public:
  using Time = std::chrono::steady_clock;

  // By the thread that looks. `is_last`: there will be no other, as the run and its process have ended.
  void set_state(const std::string& json, bool is_last);
  void set_report(ReportData report);
  // How long ago a page last asked for something.
  Time::duration since_last_question() const;
  // Every page that is open has been given the last state, and all data: nobody waits for anything.
  bool is_told() const;

  // By the threads that answer. The state, with the number of the version of the data; waits up to a second for a version
  // other than `known`.
  std::string state(std::int64_t known);
  // {"version", "head", "sections": {name: text, or null if it is that of version `known`}}.
  std::string report(std::int64_t known);

 private:
  using Hashes = std::map<std::string, std::uint64_t>;  // of the sections, by name

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::string state_ = "{}";
  ReportData report_;
  std::int64_t version_ = 0;
  std::map<std::int64_t, Hashes> hashes_;  // of the last versions
  bool is_last_ = false, is_told_ = false;
  Time::time_point asked_ = Time::time_point::min();
};

}  // namespace pulvis
