// Generates a random packing of rigid particles, in two and three dimensions: they are scattered, shaken, and pressed
// together in small steps, until they are as dense as required or nothing moves any more; then shaken and pressed again.
//
// A powder has: scatter(height, random), shake(displacement, random), squeeze(height), relax(sweeps) -> true if no overlap,
// poses(), restore(poses, height), height(), sweeps().
#pragma once

#include "scenes/outlines/portable.hpp"

#include <algorithm>
#include <cstdint>

namespace pulvis {

// Relative to a mean diameter, or to the height.
struct PressSteps {
  double loosest = 0.45;     // initial density; lower if particles find no room
  double first_step = 0.01;  // of the punch
  double widest_step = 0.02;
  double last_step = 3e-4;    // the punch rests if it cannot move this far
  double quick_step = 0.005;  // after shaking
  double faster = 1.3;        // growth of the step after an easy one
  int easy_sweeps = 60;
  int max_sweeps = 300;     // in one step
  double vibration = 0.02;  // displacement of a particle in one step
  double mixing = 0.15;     // displacement of a particle in one shake of the loose powder
  int mixings = 30;
  double hard_vibration = 0.05;  // displacement in one vibration between pressings
  int vibrations = 10;
  double lift = 0.02;  // of the punch between pressings
  int patience = 12;   // pressings without gain before stopping
  double gain = 2e-4;  // smallest increase that counts as gain
};

struct PressOrder {
  double min_height = 0;        // the punch does not go below it
  std::int64_t max_sweeps = 0;  // no shaking beyond this number; 0: none at all
  std::uint64_t seed = 1;
};

template <class Powder>
class Press {
 public:
  Press(Powder& powder, const PressOrder& order, const PressSteps& steps = {})
      : powder_(powder), order_(order), steps_(steps), random_(order.seed) {}

  // `height_at`: height as a function of density.
  template <class HeightAt>
  void run(const HeightAt& height_at) {
    throw_in(height_at);
    mix();
    press(steps_.first_step);
    if (order_.max_sweeps > 0) shake_on();
  }

 private:
  template <class HeightAt>
  void throw_in(const HeightAt& height_at) {
    double density = steps_.loosest;
    do {
      powder_.scatter(std::max(height_at(density), order_.min_height), random_);
      density *= 0.7;
    } while (!powder_.relax(10 * steps_.max_sweeps) && density > 1e-3);
  }

  // Random placement has left holes and heaps, which shaking evens out while there is room.
  void mix() { vibrate(steps_.mixing, steps_.mixings); }

  bool at_rest_on_stop() const { return powder_.height() <= order_.min_height; }

  // The punch moves down as far as it can.
  void press(double step) {
    while (step > steps_.last_step && !at_rest_on_stop()) {
      const auto poses = powder_.poses();
      const double height = powder_.height();
      const std::int64_t before = powder_.sweeps();
      powder_.squeeze(std::max(height * (1 - step), order_.min_height));
      powder_.shake(steps_.vibration * std::min(1.0, step / steps_.first_step), random_);
      if (!powder_.relax(steps_.max_sweeps)) {
        powder_.restore(poses, height);
        step /= 2;
      } else if (powder_.sweeps() - before < steps_.easy_sweeps) {
        step = std::min(step * steps_.faster, steps_.widest_step);
      }
    }
  }

  // Lifted slightly, shaken, pressed again; the densest state is kept.
  void shake_on() {
    auto best = powder_.poses();
    double minimum = powder_.height(), mark = minimum;
    for (int idle = 0;
         idle < steps_.patience && !at_rest_on_stop() && powder_.sweeps() < order_.max_sweeps;
         ++idle) {
      powder_.squeeze(powder_.height() * (1 + steps_.lift));
      vibrate(steps_.hard_vibration, steps_.vibrations);
      press(steps_.quick_step);
      if (powder_.height() < minimum) {
        minimum = powder_.height();
        best = powder_.poses();
      }
      if (minimum > mark * (1 - steps_.gain)) continue;
      mark = minimum;
      idle = -1;
    }
    powder_.restore(best, minimum);
  }

  void vibrate(double displacement, int times) {
    for (int i = 0; i < times; ++i) {
      const auto poses = powder_.poses();
      powder_.shake(displacement, random_);
      if (!powder_.relax(steps_.max_sweeps)) powder_.restore(poses, powder_.height());
    }
  }

  Powder& powder_;
  PressOrder order_;
  PressSteps steps_;
  portable::Random random_;
};

}  // namespace pulvis
