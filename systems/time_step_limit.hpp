// What sets the time step: the particle with the shortest stable step, and what makes it oscillate the fastest, an element or
// the springs of contact. Determined when asked, from the world as it is; nothing is kept during the steps.
//
// A tool under a servo does not shorten the step by its mass, which is raised instead (systems/tools/servo_kernel.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "engine/world.hpp"

namespace pulvis {

struct TimeStepLimit {
  std::int64_t step = 0;
  double time = 0;        // s
  double dt = 0;          // s, the step that is taken
  double stable = 0;      // s, the longest stable one; `dt` is `safety` times it unless shortened
  std::string shortened;  // why it is shorter; empty: it is not

  int particle = 0;            // number
  std::string particle_class;  // its class
  int element = 0;             // of it: with the shortest step or, of a mode, with the most energy
  std::string place;           // "on the surface, at an irregular node of its mesh"
  std::array<double, 3> at{};  // m, middle of the element

  // time.estimate = "highest-mode": the stable step over that of the particle's worst element; zero: not estimated.
  double gain = 0;
  bool by_mode = false;  // the mode sets the step; else the worst element, times the largest gain
  // Of the springs of contact: share of the element's squared frequency, or of the mode's energy.
  double contact_share = 0;
  double without_contact = 1;  // -, the step without contact over `stable`; of elements only
  bool by_contact() const { return contact_share >= 0.5; }

  // Steps of the elements of all particles, without contact, over the shortest of them.
  double past_slowest = 1;  // without the hundredth of them that has the shortest
  double median = 1;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(step, time, dt, stable, shortened, particle, particle_class, element, place, at, gain,
          by_mode, contact_share, without_contact, past_slowest, median);
  }
};

// s, of all particles of this process, as evaluated last.
double shortest_stable_step(const World& world);

// Of the particles of this process. Call it at the start, or when stresses belong to the positions (Step::observe).
TimeStepLimit time_step_limit(World& world);

}  // namespace pulvis
