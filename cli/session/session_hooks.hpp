// What a run calls on its way.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace pulvis {

// What is called on the thread that runs. One that throws leaves the session where it can go on.
struct SessionHooks {
  // The last sample or frame is taken: positions, forces, stresses and energies belong to t_n.
  std::function<void(double time, const std::vector<double>& row)> on_sample;
  std::function<void(std::int64_t frame)> on_frame;
  // Between two steps, where their number is a multiple: positions are of t_n, velocities of t_(n-1/2).
  std::vector<std::pair<std::int64_t, std::function<void()>>> every;
  // Between two steps, some times a second.
  std::function<void()> tick;
  // Asked after every step: the run is to stop there.
  std::function<bool()> stop;
};

}  // namespace pulvis
