// The process that a simulation or a lever belongs to.
//
// A forked child has a copy of every object, and shares the open files with its parent: what it wrote would end up in
// the middle of what the parent writes. So an object can be used only where it was made, and the child lets go of the
// folder: it neither completes the files, nor keeps the lock.
#pragma once

#include <unistd.h>

#include <filesystem>

namespace pulvis::python {

class OwnProcess {
 public:
  explicit OwnProcess(const char* what) : what_(what) {}
  ~OwnProcess() { release(); }
  OwnProcess(const OwnProcess&) = delete;
  OwnProcess& operator=(const OwnProcess&) = delete;

  bool is_here() const { return pid_ == getpid(); }
  // Throws NotNow in any other process.
  void require_here() const;

  // Files of this folder are open from now on, until it is released.
  void hold(const std::filesystem::path& folder);
  void release();

 private:
  const char* what_;  // "simulation"
  pid_t pid_ = getpid();
  std::filesystem::path folder_;
};

// In a forked child: closes all files that are held.
void let_go_of_held_files();

}  // namespace pulvis::python
