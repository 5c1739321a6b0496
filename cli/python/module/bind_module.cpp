#include "cli/python/module/module.hpp"
#include "cli/python/module/process.hpp"
#include "cli/summary.hpp"
#include "cli/tell.hpp"
#include "engine/instruction_set.hpp"

PYBIND11_MODULE(_core, core) {
  namespace py = pybind11;
  if (!__builtin_cpu_supports("avx2"))
    throw py::import_error("pulvis: this build needs a processor with AVX2");
  pulvis::hold_standard_streams();
  core.doc() = "Compiled part of pulvis.";
  core.attr("version") = pulvis::program_version();
  core.attr("commit") = pulvis::program_commit();
  core.attr("instruction_set") = pulvis::instruction_set();
  pulvis::python::bind_errors(core);
  pulvis::python::bind_scene(core);
  pulvis::python::bind_run(core);
  pulvis::python::bind_columns(core);
  pulvis::python::bind_afm(core);
  pulvis::python::bind_packing(core);
  py::module_::import("os").attr("register_at_fork")(
      py::arg("after_in_child") = py::cpp_function(&pulvis::python::let_go_of_held_files));
}
