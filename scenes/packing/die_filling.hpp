// A random packing made like a die filling: particles are poured in, the top punch is pressed down in small
// steps while they are shaken, until the target density is reached or nothing moves any more.
#pragma once

#include "scenes/packing/rigid_powder.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace pulvis {

struct DieFilling {
  std::vector<RigidShape> shapes;  // in units of the powder's mean diameter
  std::vector<int> shape_of;       // [particles]
  double width = 0;
  bool periodic = false;  // a cell instead of a die: its height is reduced
  double min_height = 0;  // the punch does not go below it
  double time_to_shake =
      1;  // shaking after nothing moves any more: 0: none, 1: as long as it may help
  std::uint64_t seed = 1;
  bool operator==(const DieFilling&) const = default;
};

struct FilledDie {
  std::vector<RigidPose> poses;
  double height = 0;
  double mean_gap = 0;  // to the three nearest neighbours, in diameters
  double min_gap = 0;   // largest proven lower bound between any two
  int touches = 0;      // pairs with a gap below 1/1000 of a diameter
};

// The runs of a study rarely differ in their packing: the most recent result is cached.
FilledDie fill_die(const DieFilling& order);

}  // namespace pulvis
