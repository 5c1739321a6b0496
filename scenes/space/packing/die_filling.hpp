// A random packing made like a die filling (scenes/packing/press.hpp), from rigid convex particles.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/space/packing/rigid_powder.hpp"

namespace pulvis::space {

struct DieFilling {
  std::vector<RigidShape> shapes = {};  // in units of the powder's mean diameter
  std::vector<int> shape_of = {};       // [particles]
  Container container = {};
  double min_height = 0;  // the punch does not go below it
  bool shaken = true;     // continue shaking after nothing moves any more
  std::uint64_t seed = 1;

  double volume() const;  // of all particles
};

struct FilledDie {
  std::vector<RigidPose> poses;
  double height = 0;
  double mean_gap = 0;  // to the three nearest neighbours, in diameters
  double min_gap = 0;   // largest proven lower bound between any two
  int touches = 0;      // pairs with a gap below 1/1000 of a diameter
};

FilledDie fill_die(const DieFilling& order);

}  // namespace pulvis::space
