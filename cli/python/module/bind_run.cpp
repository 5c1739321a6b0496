// Particle simulations: run control, series and tools.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/python/module/module.hpp"
#include "cli/python/module/python_run.hpp"
#include "cli/python/module/tool_drive.hpp"
#include "components/contact.hpp"
#include "engine/printable.hpp"
#include "scenes/results/state_hash.hpp"

namespace pulvis::python {
namespace py = pybind11;
namespace {

PythonRun::Options options_of(const std::string& folder, std::int64_t threads, bool overwrite,
                              double checkpoint_every, std::int64_t checkpoint_steps) {
  if (threads < 0 || threads > 1024)
    throw py::value_error(
        fmt::format("threads: {}, allowed: 1 to 1024, or 0 for all processors", threads));
  if (!(checkpoint_every > 0))
    throw py::value_error(fmt::format("checkpoint_every: {}, allowed: > 0 s", checkpoint_every));
  if (checkpoint_steps < 0)
    throw py::value_error(fmt::format("checkpoint_steps: {}, allowed: >= 0", checkpoint_steps));
  return {folder, static_cast<int>(threads), overwrite, checkpoint_every, checkpoint_steps};
}

bool run_until(PythonRun& run, double time) {
  if (!(time >= 0)) throw py::value_error(fmt::format("time: {}, allowed: >= 0 s", time));
  return run.go({.time = time});
}

bool take_steps(PythonRun& run, std::int64_t count) {
  if (count < 0) throw py::value_error(fmt::format("step: {} steps, allowed: >= 0", count));
  const std::int64_t taken = run.session().clock().step;
  return run.go(
      {.step = taken + std::min(count, std::numeric_limits<std::int64_t>::max() - taken)});
}

// Name, unit, label and meaning of every series except time.
py::list series_of(PythonRun& run) {
  py::list all;
  for (const SeriesInfo& one : run.session().results().series())
    all.append(py::make_tuple(one.name, one.unit, one.label, one.meaning));
  return all;
}

py::array_t<double> times_of(PythonRun& run) {
  run.session();
  return py::array_t<double>(static_cast<py::ssize_t>(run.times().size()), run.times().data());
}

// [samples, series]
py::array_t<double> rows_of(PythonRun& run) {
  const std::size_t series = run.session().results().series().size();
  py::array_t<double> all({run.rows().size(), series});
  auto to = all.mutable_unchecked<2>();
  for (std::size_t i = 0; i < run.rows().size(); ++i)
    for (std::size_t k = 0; k < series; ++k)
      to(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k)) = run.rows()[i][k];
  return all;
}

py::list verdicts_of(PythonRun& run) {
  py::list all;
  for (const Verdict& verdict : run.session().verdicts()) {
    py::dict one;
    one["what"] = verdict.what;
    one["measured"] = verdict.measured;
    one["allowed"] = verdict.allowed;
    one["value"] = verdict.value ? py::object(py::float_(*verdict.value)) : py::none();
    one["met"] = verdict.met;
    all.append(one);
  }
  return all;
}

// [nodes or elements, ordered as in the frame fields]: the mesh data for plots.
py::dict mesh_of_run(PythonRun& run) {
  const RunMesh mesh = run.session().results().mesh();
  py::dict all;
  all["quads"] = py::array_t<std::int32_t>(
      {static_cast<py::ssize_t>(mesh.quads.size() / 4), py::ssize_t{4}}, mesh.quads.data());
  if (mesh.dimension() == 3)
    all["hexahedra"] = py::array_t<std::int32_t>(
        {static_cast<py::ssize_t>(mesh.hexahedra.size() / 8), py::ssize_t{8}},
        mesh.hexahedra.data());
  all["cell_particle"] = py::array_t<std::int32_t>(
      static_cast<py::ssize_t>(mesh.cell_particle.size()), mesh.cell_particle.data());
  all["node_particle"] = py::array_t<std::int32_t>(
      static_cast<py::ssize_t>(mesh.node_particle.size()), mesh.node_particle.data());
  return all;
}

using RunClass = py::class_<PythonRun, std::shared_ptr<PythonRun>>;

void bind_course(RunClass& run) {
  const double endless = std::numeric_limits<double>::infinity();
  run.def("run", [endless](PythonRun& r) { return r.go({.time = endless}); })
      .def("run_until", &run_until)
      .def("step", &take_steps)
      .def("stop", &PythonRun::stop)
      .def("checkpoint", &PythonRun::checkpoint)
      .def("close", &PythonRun::close)
      .def("on_sample", &PythonRun::on_sample)
      .def("on_frame", &PythonRun::on_frame)
      .def("every", &PythonRun::every)
      .def("on_tick", &PythonRun::on_tick)
      .def("drive_tool", [](PythonRun& r, const std::string& name, const Point3& velocity) {
        Session& session = r.session_between_steps("the drive of a tool");
        drive_tool(session.simulation(), session.loaded().scene, name, velocity);
        session.drive("tool " + name);
      });
}

void bind_servos(RunClass& run) {
  run.def("drive_servo",
          [](PythonRun& r, const std::string& name, double force) {
            Session& session = r.session_between_steps("the force of a servo");
            drive_servo(session.simulation(), session.loaded().scene, name, force);
            session.drive("servo of tool " + name);
          })
      .def("servo",
           [](PythonRun& r, const std::string& name) {
             const ServoView servo = servo_view(r.session().simulation(), name);
             return py::make_tuple(servo.target, servo.direction, servo.holds);
           })
      .def_property_readonly("servos",
                             [](PythonRun& r) { return servo_names(r.session().simulation()); });
}

void bind_state(RunClass& run) {
  run.def_property_readonly("time", [](PythonRun& r) { return r.session().clock().time; })
      .def_property_readonly("dt", [](PythonRun& r) { return r.session().clock().dt; })
      .def_property_readonly("end", [](PythonRun& r) { return r.session().clock().end; })
      .def_property_readonly("steps", [](PythonRun& r) { return r.session().clock().step; })
      .def_property_readonly("outcome", &PythonRun::outcome)
      .def_property_readonly("threads", &PythonRun::threads)
      .def_property_readonly("series", &series_of)
      .def_property_readonly("sample_times", &times_of)
      .def_property_readonly("samples", &rows_of)
      .def_property_readonly("verdicts", &verdicts_of)
      .def_property_readonly("mesh", &mesh_of_run)
      .def_property_readonly("dimension",
                             [](PythonRun& r) { return r.session().loaded().scene.dimension; })
      .def_property_readonly("driven", [](PythonRun& r) { return r.session().driven(); })
      .def_property_readonly("elements",
                             [](PythonRun& r) { return r.session().results().elements(); })
      .def_property_readonly("warnings", [](PythonRun& r) { return r.session().quality().lines(); })
      .def_property_readonly("tools",
                             [](PythonRun& r) { return tool_names(r.session().simulation()); })
      .def_property_readonly(
          "hash", [](PythonRun& r) { return state_hash_text(r.session().simulation().world()); });
}

void raise_error(const char* name, const char* message) {
  const py::object type = py::module_::import("pulvis.errors").attr(name);
  PyErr_SetObject(type.ptr(), type(message).ptr());
}

// For requests that are not allowed at this time or for this object.
void translate_refusal(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const OutOfRange& error) {
    raise_error("RangeError", error.what());
  } catch (const NotNow& error) {
    raise_error("RunError", error.what());
  }
}

}  // namespace

void bind_run(py::module_& core) {
  py::register_exception_translator(translate_refusal);
  RunClass run(core, "Run");
  run.def(py::init([](const LoadedScene& scene, const std::string& folder, std::int64_t threads,
                      bool overwrite, double checkpoint_every, std::int64_t checkpoint_steps) {
            return std::make_shared<PythonRun>(
                scene, options_of(folder, threads, overwrite, checkpoint_every, checkpoint_steps));
          }),
          py::arg("scene"), py::arg("folder"), py::arg("threads"), py::arg("overwrite"),
          py::arg("checkpoint_every") = 60.0, py::arg("checkpoint_steps") = 0);
  run.def_static(
      "resume",
      [](const std::string& folder, std::int64_t threads, double checkpoint_every) {
        return std::make_shared<PythonRun>(folder,
                                           options_of(folder, threads, false, checkpoint_every, 0));
      },
      py::arg("folder"), py::arg("threads"), py::arg("checkpoint_every") = 60.0);
  bind_course(run);
  bind_servos(run);
  bind_state(run);
}

}  // namespace pulvis::python
