// Translates the errors of the program into those of the package: pulvis.errors.
#include <string>

#include "cli/checkpoints.hpp"
#include "cli/python/module/module.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/run_failure.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/language/units.hpp"

namespace pulvis::python {
namespace py = pybind11;
namespace {

void raise(const char* type, const std::string& message, const py::dict& where = {}) {
  const py::object error = py::module_::import("pulvis.errors").attr(type);
  const py::object made = error(message, **where);
  PyErr_SetObject(error.ptr(), made.ptr());
}

// The location is that of the first problem; `problems` has all of them.
void raise_scene_error(const SceneError& error) {
  py::list problems;
  for (const SceneProblem& problem : error.errors()) {
    py::dict one;
    one["file"] = problem.file.empty() ? py::none() : py::object(py::str(problem.file));
    one["line"] = problem.line > 0 ? py::object(py::int_(problem.line)) : py::none();
    one["column"] = problem.column > 0 ? py::object(py::int_(problem.column)) : py::none();
    one["key"] = problem.key;
    one["override"] =
        problem.override_text.empty() ? py::none() : py::object(py::str(problem.override_text));
    one["message"] = problem.message;
    problems.append(one);
  }
  py::dict where;
  for (const char* name : {"file", "line", "column", "key"})
    where[name] = py::dict(problems[0])[name];
  where["problems"] = problems;
  raise("SceneError", error.what(), where);
}

// The command-line option --overwrite is an argument in Python.
std::string in_words_of_python(std::string text) {
  const std::string option = "--overwrite";
  const std::size_t at = text.find(option);
  return at == std::string::npos ? text : text.replace(at, option.size(), "overwrite=True");
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const SceneError& error) {
    raise_scene_error(error);
  } catch (const UnitError& error) {
    raise("SceneError", error.what());
  } catch (const RunFailure& error) {
    raise("RunError", error.what());
  } catch (const CannotResume& error) {
    raise("RunError", error.what());
  } catch (const OutputError& error) {
    py::dict where;
    where["file"] = error.path().string();
    raise("RunError", in_words_of_python(error.what()), where);
  }
}

}  // namespace

void bind_errors(py::module_&) { py::register_exception_translator(translate); }

}  // namespace pulvis::python
