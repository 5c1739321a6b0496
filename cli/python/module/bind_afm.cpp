// AFM levers: calibration, friction loops, force curves.
#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "cli/python/module/interruptible.hpp"
#include "cli/python/module/module.hpp"
#include "cli/python/module/process.hpp"
#include "cli/python/module/python_run.hpp"
#include "cli/save_scene.hpp"
#include "cli/session/afm_session.hpp"
#include "cli/session/open_session.hpp"
#include "engine/interruption.hpp"
#include "engine/run_failure.hpp"
#include "scenes/lever/afm_size.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis::python {
namespace py = pybind11;
namespace {

// The run of a lever, observable after every increment.
class PythonLever {
 public:
  // Calibrates.
  PythonLever(const LoadedScene& scene, std::int64_t threads) {
    if (threads < 0 || threads > 1024)
      throw py::value_error(
          fmt::format("threads: {}, allowed: 1 to 1024, or 0 for all processors", threads));
    if (!scene.scene.afm)
      throw SceneError({{scene.scene.file.string(), 1, 1, "", "family",
                         "a scene of particles has no lever, allowed: family = \"afm\""}});
    const int workers = threads > 0 ? static_cast<int>(threads) : tbb::info::default_concurrency();
    whole([&] {
      require_afm_memory(scene.scene);
      session_ = std::make_unique<AfmSession>(scene, workers);
    });
    if (!session_->end().failure.empty()) throw RunFailure(session_->end().failure);
  }
  // If the files were not completed, they are left as after an interruption.
  ~PythonLever() {
    if (!process_.is_here()) {  // neither its files nor its threads are of this process
      (void)session_.release();
      (void)lock_.release();
      return;
    }
    try {
      if (lock_ != nullptr && !is_finished_) close();
    } catch (const std::exception&) {  // disk full: the data written before is complete
    }
  }
  PythonLever(const PythonLever&) = delete;
  PythonLever& operator=(const PythonLever&) = delete;

  void on_sample(const py::function& f) {
    require_unfinished();
    sample_calls_.push_back(f);
  }
  void on_frame(const py::function& f) {
    require_unfinished();
    frame_calls_.push_back(f);
  }
  void every(std::int64_t increments, const py::function& f) {
    if (increments < 1)
      throw py::value_error(fmt::format("every: {} increments, allowed: >= 1", increments));
    require_unfinished();
    every_calls_.emplace_back(increments, f);
  }

  void write_to(const std::string& folder, bool overwrite, double checkpoint_every,
                std::int64_t checkpoint_steps) {
    process_.require_here();
    if (folder.empty() || lock_ != nullptr || is_finished_) return;
    require_free_folder(session_->loaded(), folder);
    lock_ = std::unique_ptr<FolderLock>(new FolderLock(open_run_folder(folder, overwrite)));
    process_.hold(folder);
    save_scene(folder, session_->loaded());
    session_->write_to(folder, checkpoints(checkpoint_every, checkpoint_steps));
  }
  // Runs until its target is reached, it is stopped, or the programme ends.
  void go(const AfmSession::Target& target) {
    process_.require_here();
    if (is_going_) throw NotNow("the lever is running; allowed: after the call has returned");
    require_unfinished();
    whole([&] { session_->go(target); });
    if (session_->over()) finish();
  }
  void step(std::int64_t count) {
    if (count < 0) throw py::value_error(fmt::format("step: {} increments, allowed: >= 0", count));
    const std::int64_t made = std::max<std::int64_t>(session().increment(), 0);
    go({.increment = made + std::min(count, std::numeric_limits<std::int64_t>::max() - made)});
  }
  void run_until(double actions) {
    if (!(actions >= 0))
      throw py::value_error(fmt::format("run_until: {} actions, allowed: >= 0", actions));
    go({.actions = actions});
  }
  void stop() { stop_ = true; }
  // In a fork of its process it does nothing.
  void close() {
    if (!process_.is_here()) return;
    if (is_going_) throw NotNow("a callback cannot close its own lever");
    finish();
  }
  // Waits at the checkpoint.
  void resume(const std::string& folder, OpenFolder stopped, double checkpoint_every) {
    session_->write_to(folder, checkpoints(checkpoint_every, 0));
    lock_ = std::move(stopped.lock);
    process_.hold(folder);
    whole([&] { session_->begin(stopped.run.checkpoint.get()); });
  }
  static CheckpointOptions checkpoints(double every, std::int64_t steps) {
    if (!(every > 0))
      throw py::value_error(fmt::format("checkpoint_every: {}, allowed: > 0 s", every));
    if (steps < 0) throw py::value_error(fmt::format("checkpoint_steps: {}, allowed: >= 0", steps));
    CheckpointOptions options;
    options.every = every;
    options.steps = steps;
    return options;
  }

  const AfmSession& session() const {
    process_.require_here();
    return *session_;
  }
  bool is_finished() const { return is_finished_; }

 private:
  void require_unfinished() const {
    process_.require_here();
    if (is_finished_)
      throw NotNow(
          "the lever has already run; allowed: create another one with scene.simulation()");
  }

  // Runs without the GIL, until Ctrl-C is pressed.
  template <class Work>
  void whole(const Work& work) {
    Interruptible interruptible;
    std::exception_ptr thrown;
    stop_ = false;
    if (session_) listen(interruptible, thrown);
    is_going_ = true;
    try {
      py::gil_scoped_release others_may_run;
      work();
    } catch (const Interrupted&) {
    } catch (...) {  // such as a disk error
      is_going_ = false;
      if (session_) session_->hooks = {};
      throw;
    }
    is_going_ = false;
    if (session_) session_->hooks = {};
    // A run with a folder can be resumed; without one there are no files to lose.
    if ((thrown || interruptible.asked()) && lock_ != nullptr) finish();
    if (thrown) std::rethrow_exception(thrown);
    interruptible.raise_if_asked();
  }

  void listen(const Interruptible& interruptible, std::exception_ptr& thrown) {
    SessionHooks& hooks = session_->hooks;
    hooks.stop = [&] { return stop_ || interruptible.asked() || thrown != nullptr; };
    const auto guarded = [this, &thrown](const auto& call) {
      if (thrown) return;
      py::gil_scoped_acquire gil;
      try {
        call();
        process_.require_here();  // the callback may have forked
      } catch (...) {             // the increment is complete: the run stops after it
        thrown = std::current_exception();
      }
    };
    if (!sample_calls_.empty())
      hooks.on_sample = [this, guarded](double, const std::vector<double>&) {
        guarded([&] {
          for (const py::function& f : std::vector(sample_calls_)) f();
        });
      };
    if (!frame_calls_.empty())
      hooks.on_frame = [this, guarded](std::int64_t) {
        guarded([&] {
          for (const py::function& f : std::vector(frame_calls_)) f();
        });
      };
    for (std::size_t i = 0; i < every_calls_.size(); ++i)
      hooks.every.emplace_back(every_calls_[i].first,
                               [this, guarded, i] { guarded([&] { every_calls_[i].second(); }); });
  }

  void finish() {
    if (is_finished_ || !process_.is_here()) return;
    is_finished_ = true;
    {
      py::gil_scoped_release others_may_run;
      session_->leave();
      session_->finish();
    }
    lock_ = nullptr;
    process_.release();
    sample_calls_.clear();
    frame_calls_.clear();
    every_calls_.clear();
    const std::string& failure = session_->end().failure;
    if (!failure.empty() && !ended_as_expected(session_->loaded().scene, failure))
      throw RunFailure(failure);
  }

  OwnProcess process_{"lever"};
  std::unique_ptr<AfmSession> session_;
  std::unique_ptr<FolderLock> lock_;
  std::vector<py::function> sample_calls_, frame_calls_;
  std::vector<std::pair<std::int64_t, py::function>> every_calls_;
  std::atomic<bool> stop_{false}, is_going_{false};
  bool is_finished_ = false;
};

py::dict calibration_of(const PythonLever& lever) {
  const Calibration& c = *lever.session().report().calibration;
  py::dict all;
  all["normal_stiffness"] = c.normal_stiffness;
  all["lateral_stiffness"] = c.lateral_stiffness;
  all["longitudinal_stiffness"] = c.longitudinal_stiffness;
  all["torsional_stiffness"] = c.torsional_stiffness;
  all["normal_invols"] = c.normal_invols;
  all["lateral_invols"] = c.lateral_invols;
  all["bending_share"] = c.bending_share;
  all["twist_share"] = c.twist_share;
  all["tip_share"] = c.tip_share;
  all["arm"] = c.arm;
  if (c.mesh_error) {
    all["mesh_error_normal"] = c.mesh_error->normal;
    all["mesh_error_lateral"] = c.mesh_error->lateral;
    all["mesh_error_longitudinal"] = c.mesh_error->longitudinal;
  }
  return all;
}

py::object optional(const std::optional<double>& value) {
  return value ? py::object(py::float_(*value)) : py::none();
}

py::list loops_of(const PythonLever& lever) {
  py::list all;
  for (const FrictionLoop& loop : lever.session().report().loops) {
    py::dict one;
    one["action"] = loop.action;
    one["load"] = loop.load;
    one["trace"] = loop.trace;
    one["retrace"] = loop.retrace;
    one["half_width"] = loop.half_width;
    one["offset"] = loop.offset;
    one["volts_half_width"] = loop.volts_half_width;
    one["volts_offset"] = loop.volts_offset;
    one["friction"] = optional(loop.friction);
    one["sensitivity"] = optional(loop.sensitivity);
    one["slides"] = loop.slides;
    one["full"] = loop.full();
    all.append(one);
  }
  return all;
}

py::list curves_of(const PythonLever& lever) {
  py::list all;
  for (const ForceCurveFigures& curve : lever.session().report().curves) {
    py::dict one;
    one["action"] = curve.action;
    one["greatest"] = curve.greatest;
    one["pull_off"] = curve.pull_off;
    one["work"] = curve.work;
    one["work_of_adhesion"] = optional(curve.work_of_adhesion);
    all.append(one);
  }
  return all;
}

py::list series_of_levers() {
  py::list all;
  for (const SeriesInfo& one : afm_series())
    all.append(py::make_tuple(one.name, one.unit, one.label, one.meaning));
  return all;
}

py::array_t<double> rows_of_lever(const PythonLever& lever) {
  const AfmHistory& history = lever.session().history();
  const std::size_t series = afm_series().size();
  py::array_t<double> all({history.rows.size(), series});
  for (std::size_t i = 0; i < history.rows.size(); ++i)
    for (std::size_t k = 0; k < series; ++k)
      all.mutable_at(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k)) = history.rows[i][k];
  return all;
}

py::list verdicts_of_lever(const PythonLever& lever) {
  py::list all;
  for (const Verdict& verdict : lever.session().report().verdicts) {
    py::dict one;
    one["what"] = verdict.what;
    one["measured"] = verdict.measured;
    one["allowed"] = verdict.allowed;
    one["value"] = optional(verdict.value);
    one["met"] = verdict.met;
    all.append(one);
  }
  return all;
}

}  // namespace

void bind_afm(py::module_& core) {
  using Self = const PythonLever&;
  py::class_<PythonLever, std::shared_ptr<PythonLever>>(core, "Lever")
      .def(py::init<const LoadedScene&, std::int64_t>(), py::arg("scene"), py::arg("threads"))
      .def("write_to", &PythonLever::write_to, py::arg("folder"), py::arg("overwrite"),
           py::arg("checkpoint_every"), py::arg("checkpoint_steps"))
      .def("run", [](PythonLever& lever) { lever.go({}); })
      .def("run_until", &PythonLever::run_until)
      .def("step", &PythonLever::step)
      .def("stop", &PythonLever::stop)
      .def("close", &PythonLever::close)
      .def("on_sample", &PythonLever::on_sample)
      .def("on_frame", &PythonLever::on_frame)
      .def("every", &PythonLever::every)
      .def_property_readonly("is_finished", &PythonLever::is_finished)
      .def_property_readonly(
          "increments",
          [](Self lever) { return std::max<std::int64_t>(lever.session().increment(), 0); })
      .def_property_readonly("calibration", &calibration_of)
      .def_property_readonly("loops", &loops_of)
      .def_property_readonly("curves", &curves_of)
      .def_property_readonly("samples", &rows_of_lever)
      .def_property_readonly("verdicts", &verdicts_of_lever)
      .def_property_readonly("sample_times",
                             [](Self lever) { return lever.session().history().times; })
      .def_property_readonly("figures", [](Self lever) { return lever.session().report().figures; })
      .def_property_readonly("hash", [](Self lever) { return lever.session().report().state_hash; })
      .def_property_readonly("outcome", [](Self lever) { return lever.session().report().outcome; })
      .def_property_readonly("elements",
                             [](Self lever) { return lever.session().report().elements; });
  core.def("afm_series", &series_of_levers);
  core.def(
      "resume_lever",
      [](const std::string& folder, std::int64_t threads, double checkpoint_every) {
        OpenFolder stopped = open_stopped(folder, true);
        auto lever = std::make_shared<PythonLever>(stopped.run.scene, threads);
        lever->resume(folder, std::move(stopped), checkpoint_every);
        return lever;
      },
      py::arg("folder"), py::arg("threads"), py::arg("checkpoint_every"));
  core.def("is_lever_folder", [](const std::string& folder) {
    return load_scene(std::filesystem::path(folder) / "scene.toml").scene.afm != nullptr;
  });
}

}  // namespace pulvis::python
