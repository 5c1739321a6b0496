// Callbacks of a run.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace pulvis {

// Called on the simulation thread. If one throws, the session can still be continued.
struct SessionHooks {
  // The last sample or frame has been taken: positions, forces, stresses and energies belong to t_n.
  std::function<void(double time, const std::vector<double>& row)> on_sample;
  std::function<void(std::int64_t frame)> on_frame;
  // Between two steps, at multiples of the number of steps: positions at t_n, velocities at t_(n-1/2).
  std::vector<std::pair<std::int64_t, std::function<void()>>> every;
  // Between two steps, a few times per second.
  std::function<void()> tick;
  // Called after every step: true stops the run there.
  std::function<bool()> stop;
};

}  // namespace pulvis
