// Ctrl-C during long work of the program, while Python's own handler has no turn.
#pragma once

namespace pulvis::python {

// On Python's main thread SIGINT is a wish to stop (engine/interruption.hpp) while one of these lives, and Python is told
// of it, too. On others signals do not arrive, and it does nothing. The GIL is held when it is made and ends.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  bool asked() const;
  // With the GIL: KeyboardInterrupt, or what the handler in Python raises. Without such the wish is withdrawn.
  void raise_if_asked();

 private:
  bool listens_ = false;
};

}  // namespace pulvis::python
