// Experimental friction loops for the wedge calibration (scenes/wedge/wedge_calibration.hpp).
//
// One CSV file: `slope` of the facet (> 0: the trace runs uphill), `load`, and either
//   half_width, offset   volts of each loop, with half_width_error, offset_error if known
//   trace, retrace       raw traces in volts, one row per position; consecutive rows of the same slope and
//                        load form one loop, a repetition begins where `position`, if present, returns to
//                        its start, and a share of `skip` is left out at both ends, where the tip
//                        sticks after the reversal
// Half-width and offset of raw traces are half the difference and half the sum of their means. The error of
// a mean is s/sqrt(n_eff), n_eff = n (1 - r)/(1 + r) with r the correlation of neighbours.
#pragma once

#include <filesystem>
#include <vector>

#include "scenes/wedge/wedge_calibration.hpp"

namespace pulvis::wedge {

// Whether the first line contains columns of loops, although others may be missing or misspelt.
bool holds_loops(const std::filesystem::path& file);

// Throws SceneError with file, line and what is allowed.
std::vector<Loop> read_loops(const std::filesystem::path& file, double skip);

}  // namespace pulvis::wedge
