// Systems in order, each added only if the scene needs it.
#pragma once

#include <utility>
#include <vector>

#include "engine/system.hpp"
#include "engine/world.hpp"

namespace pulvis {

class SystemList {
 public:
  explicit SystemList(World& world, When when = When::every_step) : world_(world), when_(when) {}
  template <class S>
  void add(const char* name, bool asked = true) {
    if (asked) systems_.push_back(make_system<S>(world_, name, when_));
  }
  std::vector<System> taken() { return std::move(systems_); }

 private:
  World& world_;
  When when_;
  std::vector<System> systems_;
};

}  // namespace pulvis
