// How a named array is declared, and the number types that index it.
//
// A kind of entity is what arrays have rows for: nodes, elements, contacts... The kinds themselves are declared in
// components/; the engine only knows that a kind has rows, and that the rows of some kinds stand in
// slots of eight lanes, chunk by chunk (AoSoA), while others are plain lists.
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>

namespace pulvis {

// Particles of a chunk, worked on side by side.
inline constexpr int lane_count = 8;

// Row of a plain table, or slot (eight lanes) of a laned one. Rows of different kinds of entities do not mix.
template <class Entity>
struct Row {
  std::int32_t value = 0;
  constexpr Row() = default;
  constexpr explicit Row(std::int64_t v) : value(static_cast<std::int32_t>(v)) {}
  auto operator<=>(const Row&) const = default;
};

struct ComponentInfo {
  const char* name;
  const char* unit;
  const char* meaning;
};

// Base of a declaration:
//   struct Velocity : Component<Node, double, 2> {
//     static constexpr ComponentInfo info{"velocity", "m/s", "..."};
//   };
template <class EntityTag, class Value, int Count>
struct Component {
  using Entity = EntityTag;
  using value_type = Value;
  static constexpr int count = Count;
  // A declaration may set this: what one system of a pass over the chunks leaves for the next ones, and
  // nobody needs later. A graph may then keep it for one chunk a worker only, in cache; see TaskGraph.
  static constexpr bool transient = false;
  // Or this: what one system writes and reads again while it works on a chunk, and nobody else looks at. Every worker has
  // room for a chunk of it; the world has no such column.
  static constexpr bool scratch = false;
};

template <class C>
concept IsComponent = requires {
  typename C::Entity;
  typename C::value_type;
  C::count;
  C::info;
};

// Anything else that systems share by name: connectivity, the clock, totals.
template <class R>
concept IsResource = !IsComponent<R> && requires {
  R::resource_name;
};

class LookAhead;
class World;

// One chunk of laned rows: the eight particles that a chunk system works on.
struct Chunk {
  std::int32_t index = 0;
  std::int32_t worker = 0;     // that works on it
  LookAhead* ahead = nullptr;  // for busy systems; see BusyChunk
  bool drops = false;          // transient rows are the worker's, where it has room for them
};

// Of a system that divides the whole world into tasks far smaller than a chunk. It begins when the chunks that can
// be computed beside it have been taken: its tasks then fill the time in which a thread would wait for another's
// chunk.
struct SmallTasks {};

// Identity of a component, resource or kind of entity type at run time.
using TypeKey = const void*;
template <class T>
TypeKey type_key() {
  static const char key = 0;
  return &key;
}

}  // namespace pulvis
