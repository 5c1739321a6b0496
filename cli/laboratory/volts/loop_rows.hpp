// Where one raw friction loop ends in a table and the next begins.
#pragma once

#include <cstddef>
#include <span>

namespace pulvis::volts {

struct LoopRows {                                 // one value per row
  std::span<const double> slope, load, position;  // no position: empty
};

// The row after the loop that begins at `begin`: where slope or load changes, or where the position returns
// towards its start by more than half its range, as between repetitions at the same slope and load. A smaller
// step back is the noise of a position sensor.
std::size_t end_of_loop(const LoopRows& rows, std::size_t begin);

}  // namespace pulvis::volts
