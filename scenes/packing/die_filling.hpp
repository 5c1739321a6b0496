// A random packing the way a die is filled: particles thrown in, the top punch pressed down on them in small
// steps while they are shaken, until the die is as dense as wanted or nothing moves any more.
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
  bool periodic = false;  // a cell instead of a die: its height is squeezed
  double min_height = 0;  // the punch goes no farther
  double time_to_shake =
      1;  // on after nothing moves any more: 0 not at all, 1 as long as it may pay
  std::uint64_t seed = 1;
  bool operator==(const DieFilling&) const = default;
};

struct FilledDie {
  std::vector<RigidPose> poses;
  double height = 0;
  double mean_gap = 0;  // to the three nearest neighbours, in diameters
  double min_gap = 0;   // largest that is known to lie between any two
  int touches = 0;      // pairs with a gap below a thousandth of a diameter
};

// The runs of a study differ in little, and few of them in their packing: what was asked for last is kept.
FilledDie fill_die(const DieFilling& order);

}  // namespace pulvis
