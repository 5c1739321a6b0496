// What a state's hash sees and what not, for the tests of levers and powders alike.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "scenes/results/state_hash.hpp"

namespace pulvis {

// Whether the last bit of `value`, a number of `world`, counts. It is put back.
inline bool last_bit_counts(const World& world, double& value) {
  const std::uint64_t before = state_hash(world);
  const double kept = value;
  value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1U);
  const bool seen = state_hash(world) != before;
  value = kept;
  EXPECT_EQ(state_hash(world), before);
  return seen;
}

}  // namespace pulvis
