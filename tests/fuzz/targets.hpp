// What is fuzzed: readers that get whatever a file holds. A target may throw only what its reader promises to
// throw; anything else, a crash or a hang is a fault. libFuzzer drives one of them (fuzz_main.cpp); the
// corpus is played back to all of them in every test run (replay.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace pulvis::fuzz {

struct Target {
  const char* name;
  void (*run)(std::span<const std::uint8_t> input);
};

std::span<const Target> targets();

}  // namespace pulvis::fuzz
