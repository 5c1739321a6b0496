// Places, components and a resource of the engine's own tests: the engine knows no particles.
#pragma once

#include <exception>
#include <string>

#include "engine/access.hpp"

namespace pulvis::engine_test {

// What an action throws, as its message; "" when it throws nothing.
template <class Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

struct Cell {  // laned, by chunk
  static constexpr const char* name = "cell";
  static constexpr bool laned = true, by_chunk = true;
};
struct Bead {  // plain, by chunk
  static constexpr const char* name = "bead";
  static constexpr bool laned = false, by_chunk = true;
};
struct Link {  // plain, not divided by chunks
  static constexpr const char* name = "link";
  static constexpr bool laned = false, by_chunk = false;
};

struct Heat : Component<Cell, double, 2> {
  static constexpr ComponentInfo info{"heat", "J", "of a cell"};
};
struct Flux : Component<Cell, double, 1> {
  static constexpr ComponentInfo info{"flux", "W", "into a cell"};
};
struct Passing : Component<Cell, double, 1> {
  static constexpr ComponentInfo info{"passing", "J", "left by one system for the next"};
  static constexpr bool transient = true;
};
struct Workspace : Component<Cell, double, 2> {
  static constexpr ComponentInfo info{"workspace", "J", "of one system, while it works on a chunk"};
  static constexpr bool scratch = true;
};
struct Weight : Component<Bead, double, 1> {
  static constexpr ComponentInfo info{"weight", "N", "of a bead"};
};
struct Ends : Component<Link, std::int32_t, 2> {
  static constexpr ComponentInfo info{"ends", "-", "beads that a link joins"};
};
struct Force : Component<Link, double, 1> {
  static constexpr ComponentInfo info{"force", "N", "in a link"};
};
struct Clockwork {
  static constexpr const char* resource_name = "clockwork";
  double time = 0;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(time);
  }
};

}  // namespace pulvis::engine_test
