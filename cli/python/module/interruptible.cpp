#include "cli/python/module/interruptible.hpp"

#include <pybind11/pybind11.h>

#include <csignal>

#include "engine/interruption.hpp"

namespace pulvis::python {
namespace py = pybind11;
namespace {

int depth = 0;  // a callback may run another simulation
void (*pythons_handler)(int) = SIG_DFL;

void ask_both(int signal) {
  ask_to_stop();
  if (pythons_handler != SIG_DFL && pythons_handler != SIG_IGN) pythons_handler(signal);
}

bool is_main_thread() {
  const py::object main = py::module_::import("threading").attr("main_thread")();
  return main.attr("ident").cast<unsigned long>() == PyThread_get_thread_ident();
}

}  // namespace

Interruptible::Interruptible() : listens_(is_main_thread()) {
  if (listens_ && depth++ == 0) {
    withdraw_wish_to_stop();
    pythons_handler = std::signal(SIGINT, ask_both);
  }
}

Interruptible::~Interruptible() {
  if (!listens_ || --depth > 0) return;
  std::signal(SIGINT, pythons_handler);
  withdraw_wish_to_stop();
}

bool Interruptible::asked() const { return listens_ && asked_to_stop(); }

void Interruptible::raise_if_asked() {
  if (!asked()) return;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  withdraw_wish_to_stop();
}

}  // namespace pulvis::python
