// Ctrl-C during long-running C++ code, while Python's signal handler cannot run.
#pragma once

namespace pulvis::python {

// RAII guard: on Python's main thread it turns SIGINT into a stop request (engine/interruption.hpp) and also forwards it
// to Python. Other threads receive no signals, so there it does nothing. Construct and destroy it with the GIL held.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  bool asked() const;
  // Requires the GIL. Throws KeyboardInterrupt, or what the Python handler raises; else withdraws the request.
  void raise_if_asked();

 private:
  bool listens_ = false;
};

}  // namespace pulvis::python
