// The compiled part of the Python package, pulvis._core. Each file binds one topic; cli/python/pulvis wraps it in the
// public interface.
#pragma once

#include <pybind11/pybind11.h>

namespace pulvis::python {

void bind_errors(pybind11::module_& core);
void bind_scene(pybind11::module_& core);
void bind_run(pybind11::module_& core);
void bind_columns(pybind11::module_& core);
void bind_afm(pybind11::module_& core);
void bind_packing(pybind11::module_& core);

}  // namespace pulvis::python
