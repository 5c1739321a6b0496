// A random packing made like a die filling: particles are poured in, the top punch is pressed down in small steps while
// they are shaken, until the target density is reached or nothing moves any more (scenes/packing/press.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/packing/rigid_powder.hpp"

namespace pulvis {

template <class D>
struct DieFilling {
  std::vector<typename RigidTypes<D>::Shape> shapes = {};  // in units of the powder's mean diameter
  std::vector<int> shape_of = {};                          // [particles]
  typename RigidTypes<D>::Container container = {};
  double min_height = 0;  // the punch does not go below it
  bool shaken = true;     // continue shaking after nothing moves any more
  std::uint64_t seed = 1;
  bool operator==(const DieFilling&) const = default;
};

template <class D>
struct FilledDie {
  std::vector<typename RigidTypes<D>::Pose> poses;
  double height = 0;
  double mean_gap = 0;  // to the three nearest neighbours, in diameters
  double min_gap = 0;   // largest proven lower bound between any two
  int touches = 0;      // pairs with a gap below 1/1000 of a diameter
};

// The runs of a study rarely differ in their packing: the most recent results are cached.
template <class D>
FilledDie<D> fill_die(const DieFilling<D>& order);

extern template FilledDie<TwoD> fill_die(const DieFilling<TwoD>& order);
extern template FilledDie<ThreeD> fill_die(const DieFilling<ThreeD>& order);

}  // namespace pulvis
