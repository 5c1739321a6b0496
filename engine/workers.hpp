// The threads of a run: a fixed number, all with denormals flushed to zero.
#pragma once

#include <functional>
#include <memory>

namespace pulvis {

class Workers {
 public:
  explicit Workers(int threads);
  ~Workers();

  // Runs `body` in the arena. Afterwards the floating-point mode of the calling thread is restored.
  void run(const std::function<void()>& body);

 private:
  struct Arena;  // hides the threading library from callers
  std::unique_ptr<Arena> arena_;
};

}  // namespace pulvis
