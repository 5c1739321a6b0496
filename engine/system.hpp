// A system: a plain function whose parameters declare what it reads and writes.
//
//   void integrate(Chunk chunk, Read<Clock> clock, Read<NodeMass> m, Write<Velocity> v, ...);
//
// With a leading Chunk it works on the rows of one chunk and may be fused with its neighbours in the
// step list; without, it works on the whole world, and in many small tasks where it takes SmallTasks.
#pragma once

#include <concepts>
#include <functional>
#include <tuple>

#include "engine/access.hpp"
#include "engine/look_ahead.hpp"

namespace pulvis {

// When a system runs: every step, or only on the steps whose results are sampled into the history.
enum class When { every_step, on_sample };

struct System {
  std::string name;
  When when = When::every_step;
  bool by_chunk = false;
  bool busy = false;         // takes a BusyChunk
  bool small_tasks = false;  // takes SmallTasks
  std::vector<AccessInfo> accesses;
  std::function<void(Chunk)> run;  // a world system ignores the chunk
};

namespace detail {

template <class Access>
bool present(const World&) {
  return true;
}
template <class Access>
requires requires(World& w) { Access(w).operator bool(); }
bool present(const World& world) { return static_cast<bool>(Access(const_cast<World&>(world))); }

template <class Access>
void declare(const World& world, std::vector<AccessInfo>& accesses) {
  if constexpr (!std::is_same_v<Access, SmallTasks>)
    if (present<Access>(world)) accesses.push_back(Access::info());
}

void check_chunk_writes(const System& system);

}  // namespace detail

template <std::derived_from<Chunk> C, class... Access>
System make_system(World& world, std::string name, void (*function)(C, Access...),
                   When when = When::every_step) {
  System system{std::move(name), when, true, std::is_same_v<C, BusyChunk>, false, {}, {}};
  (detail::declare<Access>(world, system.accesses), ...);
  system.run = [function, handles = std::tuple<Access...>(Access(world)...)](Chunk chunk) {
    std::apply([&](const auto&... handle) { function(C{chunk}, handle...); }, handles);
  };
  detail::check_chunk_writes(system);
  return system;
}

template <class... Access>
System make_system(World& world, std::string name, void (*function)(Access...),
                   When when = When::every_step) {
  System system{
      std::move(name), when, false, false, (std::is_same_v<Access, SmallTasks> || ...), {}, {}};
  (detail::declare<Access>(world, system.accesses), ...);
  system.run = [function, handles = std::tuple<Access...>(Access(world)...)](Chunk) {
    std::apply([&](const auto&... handle) { function(handle...); }, handles);
  };
  return system;
}

}  // namespace pulvis
