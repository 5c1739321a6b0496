#include "cli/python/module/python_run.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include "cli/python/module/interruptible.hpp"
#include "engine/run_failure.hpp"
#include "scenes/memory_need.hpp"

namespace pulvis::python {
namespace py = pybind11;
namespace {

int workers(int asked) { return asked > 0 ? asked : tbb::info::default_concurrency(); }

Session::Options session_options(const PythonRun::Options& given, int threads) {
  CheckpointOptions checkpoints;
  checkpoints.every = given.checkpoint_every;
  checkpoints.steps = given.checkpoint_steps;
  return {given.folder, threads, false, checkpoints};
}

}  // namespace

PythonRun::PythonRun(const LoadedScene& scene, const Options& options)
    : threads_(workers(options.threads)) {
  {
    py::gil_scoped_release others_may_run;
    open_ = open_session(scene, session_options(options, threads_), options.overwrite);
  }
  if (!options.folder.empty()) process_.hold(options.folder);
  listen();
}

PythonRun::PythonRun(const std::string& folder, const Options& options)
    : threads_(workers(options.threads)) {
  {
    py::gil_scoped_release others_may_run;
    OpenFolder stopped = open_stopped(folder, true);
    const LoadedScene& loaded = stopped.run.scene;
    require_memory(loaded.scene);
    open_.lock = std::move(stopped.lock);
    open_.session = std::make_unique<Session>(loaded, session_options(options, threads_),
                                              std::make_unique<Simulation>(loaded.scene, threads_));
    open_.session->go_on_from(*stopped.run.checkpoint);
  }
  process_.hold(folder);
  listen();
}

// If the files were not completed, they are left as after an interruption.
PythonRun::~PythonRun() {
  if (!process_.is_here()) {  // neither its files nor its threads are of this process
    (void)open_.session.release();
    (void)open_.lock.release();
    return;
  }
  try {
    py::gil_scoped_release others_may_run;
    if (!is_closed_ && open_.session) leave_whole();
    open_ = {};
  } catch (const std::exception&) {  // disk full: the data written before is complete
  }
}

void PythonRun::listen() {
  SessionHooks& hooks = open_.session->hooks;
  hooks.on_sample = [this](double time, const std::vector<double>& row) {
    times_.push_back(time);
    rows_.push_back(row);
    if (sample_calls_.empty()) return;
    py::gil_scoped_acquire gil;
    for (const py::function& f : std::vector(sample_calls_)) call(f);
  };
  hooks.on_frame = [this](std::int64_t) {
    if (frame_calls_.empty()) return;
    py::gil_scoped_acquire gil;
    for (const py::function& f : std::vector(frame_calls_)) call(f);
  };
}

void PythonRun::call(const py::function& f) {
  is_calling_ = true;
  struct Done {
    std::atomic<bool>& flag;
    ~Done() { flag = false; }
  } done{is_calling_};
  f();
  process_.require_here();  // the callback may have forked
}

void PythonRun::require_open() const {
  if (is_closed_) throw NotNow("the simulation is closed");
}

void PythonRun::on_sample(const py::function& f) {
  session();
  require_open();
  sample_calls_.push_back(f);
}

void PythonRun::on_frame(const py::function& f) {
  session();
  require_open();
  frame_calls_.push_back(f);
}

void PythonRun::every(std::int64_t steps, const py::function& f) {
  if (steps < 1) throw py::value_error(fmt::format("every: {} steps, allowed: >= 1", steps));
  if (is_calling_) throw NotNow("every: a callback cannot register another callback of this kind");
  Session& run = session();
  require_open();
  auto shared = std::shared_ptr<py::function>(new py::function(f), [](py::function* held) {
    py::gil_scoped_acquire gil;
    delete held;
  });
  run.hooks.every.emplace_back(steps, [this, shared] {
    py::gil_scoped_acquire gil;
    call(*shared);
  });
}

void PythonRun::on_tick(const py::object& f) {
  Session& run = session();
  tick_call_ = f;
  run.hooks.tick = nullptr;
  if (!f.is_none())
    run.hooks.tick = [this] {
      py::gil_scoped_acquire gil;
      call(py::function(tick_call_));
    };
}

Session& PythonRun::session() {
  process_.require_here();
  if (is_going_ && !(is_calling_ && who_ == std::this_thread::get_id()))
    throw NotNow(
        "the simulation is running in another thread; allowed: in its callbacks, or after the call "
        "has returned");
  return *open_.session;
}

Session& PythonRun::session_between_steps(const char* what) {
  Session& run = session();
  require_open();
  if (!is_going_) run.move();  // an exception in a callback left it at a sample
  if (run.observed())
    throw NotNow(
        fmt::format("{} cannot be changed at a sample, in the middle of a step; allowed: "
                    "in sim.every(steps, f) or between two calls of run, run_until, step",
                    what));
  if (run.ended()) throw NotNow(fmt::format("{} cannot be changed: the run has ended", what));
  return run;
}

Session::Halt PythonRun::halt_of(const Session::Target& target,
                                 const Interruptible& interruptible) {
  Session& run = *open_.session;
  run.hooks.stop = [&] { return stop_.load() || interruptible.asked(); };
  struct Going {
    PythonRun& run;
    ~Going() {
      run.is_going_ = false;
      run.open_.session->hooks.stop = nullptr;
    }
  } going{*this};
  who_ = std::this_thread::get_id();
  is_going_ = true;
  py::gil_scoped_release others_may_run;
  return run.go(target);
}

void PythonRun::complete(const Interruptible& interruptible) {
  const auto asked = [&] { return interruptible.asked(); };
  py::gil_scoped_release others_may_run;
  Session& run = *open_.session;
  run.judge({}, asked);
  if (asked()) {
    run.write_checkpoint();
    run.finish("interrupted");
    return;
  }
  run.finish("done");
  run.remove_checkpoints();
  outcome_ = "done";
}

void PythonRun::fail(const std::string& message, const Interruptible& interruptible) {
  py::gil_scoped_release others_may_run;
  Session& run = *open_.session;
  run.judge(message, [&] { return interruptible.asked(); });
  const bool expected = ended_as_expected(run.loaded().scene, message);
  outcome_ = (expected ? "stopped as expected: " : "failed: ") + message;
  run.finish(outcome_);
  if (!expected) throw RunFailure(message);
}

// Writes a checkpoint and leaves the files as after an interruption. The run may still continue.
void PythonRun::leave_whole() {
  Session& run = *open_.session;
  if (!process_.is_here() || !outcome_.empty() || !run.open()) return;
  run.write_checkpoint();
  run.finish("interrupted");
}

bool PythonRun::go(const Session::Target& target) {
  Session& run = session();
  if (is_going_) throw NotNow("a callback cannot take steps of its own simulation");
  require_open();
  if (!outcome_.empty()) return true;
  Interruptible interruptible;
  stop_ = false;
  run.reopen();
  try {
    const Session::Halt halt = halt_of(target, interruptible);
    if (halt == Session::Halt::end) complete(interruptible);
    if (interruptible.asked()) leave_whole();
  } catch (const RunFailure& failure) {
    fail(failure.what(), interruptible);
  } catch (const py::error_already_set&) {
    leave_whole();
    throw;
  }
  if (!outcome_.empty()) forget_calls();
  interruptible.raise_if_asked();
  return !outcome_.empty();
}

// Callbacks may reference the simulation; that cycle would never be freed.
void PythonRun::forget_calls() {
  sample_calls_.clear();
  frame_calls_.clear();
  tick_call_ = py::none();
  open_.session->hooks = {};
}

void PythonRun::checkpoint() {
  Session& run = session_between_steps("checkpoint");
  if (run.folder().empty())
    throw NotNow("checkpoint: the simulation has no folder; allowed: scene.simulation(folder=...)");
  run.reopen();
  run.write_checkpoint();
}

void PythonRun::close() {
  if (!process_.is_here()) return;
  session();
  if (is_going_) throw NotNow("a callback cannot close its own simulation");
  if (is_closed_) return;
  {
    py::gil_scoped_release others_may_run;
    leave_whole();
    open_.lock = nullptr;
  }
  is_closed_ = true;
  process_.release();
}

}  // namespace pulvis::python
