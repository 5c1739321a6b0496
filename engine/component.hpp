// How named arrays are declared, and the index types for their rows.
//
// An entity type is what arrays have rows for: nodes, elements, contacts... The entity types are declared in
// components/; the engine only knows that they have rows, and that the rows of some types are stored in
// slots of eight lanes, chunk by chunk (AoSoA), while others are plain lists.
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>

namespace pulvis {

// Particles per chunk, processed in parallel SIMD lanes.
inline constexpr int lane_count = 8;

// Row of a plain table, or slot (eight lanes) of a laned one. Rows of different entity types cannot be mixed up.
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

// Base class of a declaration:
//   struct Velocity : Component<Node, double, 2> {
//     static constexpr ComponentInfo info{"velocity", "m/s", "..."};
//   };
template <class EntityTag, class Value, int Count>
struct Component {
  using Entity = EntityTag;
  using value_type = Value;
  static constexpr int count = Count;
  // A declaration may set this for data that one system of a pass over the chunks leaves for the next ones, and
  // that nobody needs later. A graph may then keep it for only one chunk per worker, in cache; see TaskGraph.
  static constexpr bool transient = false;
  // Or this, for data that one system writes and reads back while it works on a chunk, and no other uses. Each worker
  // has a buffer for one chunk of it; the world has no such column.
  static constexpr bool scratch = false;
};

template <class C>
concept IsComponent = requires {
  typename C::Entity;
  typename C::value_type;
  C::count;
  C::info;
};

// Anything else that systems share by name: connectivity, the clock, sums over the run.
template <class R>
concept IsResource = !IsComponent<R> && requires {
  R::resource_name;
};

class LookAhead;
class World;

// One chunk of laned rows: the eight particles that a chunk system processes together.
struct Chunk {
  std::int32_t index = 0;
  std::int32_t worker = 0;     // index of the worker that processes it
  LookAhead* ahead = nullptr;  // for compute-bound systems; see BusyChunk
  bool drops = false;          // transient rows are in the worker's buffer, where it has one
};

// For a system that divides the whole world into tasks much smaller than a chunk. It starts once all chunks that can
// be computed concurrently have been taken: its tasks then fill the time in which a thread would otherwise wait for
// a chunk of another thread.
struct SmallTasks {};

// Run-time identity of a component, resource or entity type.
using TypeKey = const void*;
template <class T>
TypeKey type_key() {
  static const char key = 0;
  return &key;
}

}  // namespace pulvis
