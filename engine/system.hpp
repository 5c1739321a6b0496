// A system: a struct whose members declare what it reads and writes, and whose call operator does the work.
//
//   struct integrate {
//     Read<Clock> clock;
//     Read<Density> density;
//     Write<Velocity> velocity;
//     void operator()(Chunk chunk) const;
//   };
//
// If called with a Chunk, it works on the rows of one chunk and may be fused with its neighbours in the step list;
// if called without arguments, on the whole world; with SmallTasks, on the whole world in many small tasks. A
// plain function of accesses and bundles, optionally with a Chunk first, is a system too.
#pragma once

#include <concepts>
#include <functional>
#include <tuple>

#include "engine/access.hpp"
#include "engine/look_ahead.hpp"

namespace pulvis {

// When a system runs: in every step, or only in steps whose results are sampled for the history output.
enum class When { every_step, on_sample };

struct System {
  std::string name;
  When when = When::every_step;
  bool by_chunk = false;
  bool busy = false;         // takes a BusyChunk: compute-bound
  bool small_tasks = false;  // takes SmallTasks
  std::vector<AccessInfo> accesses;
  std::function<void(Chunk)> run;  // a world system ignores the chunk
};

namespace detail {
void check_chunk_writes(const System& system);
}  // namespace detail

template <IsBundle S>
System make_system(World& world, std::string name, When when = When::every_step) {
  constexpr bool by_chunk = std::invocable<const S&, BusyChunk>;
  constexpr bool busy = by_chunk && !std::invocable<const S&, Chunk>;
  constexpr bool small_tasks = std::invocable<const S&, SmallTasks>;
  System system{std::move(name), when, by_chunk, busy, small_tasks, {}, {}};
  system.run = [opened = detail::Opener{world, &system.accesses}.template open<S>()](Chunk chunk) {
    if constexpr (busy)
      opened(BusyChunk{chunk});
    else if constexpr (by_chunk)
      opened(chunk);
    else if constexpr (small_tasks)
      opened(SmallTasks{});
    else
      opened();
  };
  if (by_chunk) detail::check_chunk_writes(system);
  return system;
}

template <std::derived_from<Chunk> C, class... Access>
System make_system(World& world, std::string name, void (*function)(C, Access...),
                   When when = When::every_step) {
  System system{std::move(name), when, true, std::is_same_v<C, BusyChunk>, false, {}, {}};
  [[maybe_unused]] const detail::Opener opener{world, &system.accesses};
  system.run = [function,
                handles = std::tuple<Access...>{opener.template open<Access>()...}](Chunk chunk) {
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
  [[maybe_unused]] const detail::Opener opener{world, &system.accesses};
  system.run = [function,
                handles = std::tuple<Access...>{opener.template open<Access>()...}](Chunk) {
    std::apply([&](const auto&... handle) { function(handle...); }, handles);
  };
  return system;
}

}  // namespace pulvis
