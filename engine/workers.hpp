// The threads of a run: a fixed number, each flushing denormals to zero.
#pragma once

#include <functional>
#include <memory>

namespace pulvis {

class Workers {
 public:
  explicit Workers(int threads);
  ~Workers();

  // Runs `body` inside the arena. The calling thread's own floating-point mode is put back after.
  void run(const std::function<void()>& body);

 private:
  struct Arena;  // its library is no business of those who only run
  std::unique_ptr<Arena> arena_;
};

}  // namespace pulvis
