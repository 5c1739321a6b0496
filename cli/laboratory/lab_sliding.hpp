// Start, end and distance of sliding, from the logger's LVDT signal.
#pragma once

#include "cli/laboratory/lab_record.hpp"
#include "scenes/solve/lab_fit.hpp"

#include <optional>
#include <vector>

namespace pulvis::lab {

struct Sliding {  // as recorded by the logger
  Event start;
  std::optional<Event> end;      // empty: the record ends while the plate moves
  double last_time = 0;          // s, the end or the last sample
  std::vector<double> distance;  // m, of every sample, 0 while the plate is at rest at the start
};

Sliding find_sliding(const LoggerRecord& logger, const Settings& settings);

}  // namespace pulvis::lab
