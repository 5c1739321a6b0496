#include "engine/activity.hpp"

#include <map>
#include <mutex>
#include <utility>

namespace pulvis {
namespace {

struct Activities {
  std::mutex mutex;
  std::map<int, std::string> all;  // by number: the largest is the innermost
  int started = 0;
};

Activities& activities() {
  static Activities one;
  return one;
}

}  // namespace

Activity::Activity(std::string what) {
  Activities& now = activities();
  const std::lock_guard lock(now.mutex);
  number_ = now.started++;
  now.all.emplace(number_, std::move(what));
}

Activity::~Activity() {
  Activities& now = activities();
  const std::lock_guard lock(now.mutex);
  now.all.erase(number_);
}

std::string Activity::current() {
  Activities& now = activities();
  const std::lock_guard lock(now.mutex);
  return now.all.empty() ? "" : now.all.rbegin()->second;
}

}  // namespace pulvis
