// What a long computation before the first step is doing, for a line of progress.
#pragma once

#include <string>

namespace pulvis {

// Names the activity of the process while it exists; the innermost one counts. May be used on any thread.
class Activity {
 public:
  explicit Activity(std::string what);
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

  static std::string current();  // empty if there is none

 private:
  int number_;
};

}  // namespace pulvis
