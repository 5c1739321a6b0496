// A particle simulation as seen from Python: a session, its folder, and the rules for access to it.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "cli/python/module/process.hpp"
#include "cli/session/open_session.hpp"

namespace pulvis::python {

// A request that is not allowed at this time or for this object: pulvis.RunError.
class NotNow : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A value out of its range: pulvis.RangeError.
class OutOfRange : public NotNow {
 public:
  using NotNow::NotNow;
};

class PythonRun {
 public:
  struct Options {
    std::string folder;  // empty: nothing is written
    int threads = 0;     // 0: all processors
    bool overwrite = false;
    double checkpoint_every = 60;  // s, wall-clock time
    std::int64_t checkpoint_steps = 0;
  };
  PythonRun(const LoadedScene& scene, const Options& options);
  PythonRun(const std::string& folder, const Options& options);  // resumes
  ~PythonRun();
  PythonRun(const PythonRun&) = delete;
  PythonRun& operator=(const PythonRun&) = delete;

  // Requires the GIL and releases it during steps. Returns true when the run has ended.
  bool go(const Session::Target& target);
  void stop() { stop_ = true; }  // from a callback or another thread: stops after this step
  void checkpoint();
  // In a fork of its process it does nothing.
  void close();

  void on_sample(const pybind11::function& call);
  void on_frame(const pybind11::function& call);
  void every(std::int64_t steps, const pybind11::function& call);
  void on_tick(const pybind11::object& call);  // None: removes it

  // Throws NotNow while another thread takes steps, and in a fork of its process.
  Session& session();
  // For changes of state: between two steps, in `every` or when no `run` call is active.
  Session& session_between_steps(const char* what);
  const std::string& outcome() const { return outcome_; }
  const std::vector<double>& times() const { return times_; }
  const std::vector<std::vector<double>>& rows() const { return rows_; }
  int threads() const { return threads_; }

 private:
  void listen();
  void require_open() const;
  void call(const pybind11::function& f);
  Session::Halt halt_of(const Session::Target& target, const class Interruptible& interruptible);
  void complete(const class Interruptible& interruptible);
  void fail(const std::string& message, const class Interruptible& interruptible);
  void leave_whole();
  void forget_calls();

  OwnProcess process_{"simulation"};
  int threads_;
  OpenSession open_;
  std::string outcome_;
  std::vector<double> times_;
  std::vector<std::vector<double>> rows_;
  std::vector<pybind11::function> sample_calls_, frame_calls_;
  pybind11::object tick_call_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> is_going_{false}, is_calling_{false};
  std::thread::id who_;
  bool is_closed_ = false;
};

}  // namespace pulvis::python
