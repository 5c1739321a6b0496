// Start, end and distance of sliding, from the logger's LVDT.
#pragma once

#include "scenes/lever/lab_fit.hpp"
#include "scenes/records/lab_record.hpp"

#include <optional>
#include <vector>

namespace pulvis::lab {

struct Sliding {  // as the logger saw it
  Event start;
  std::optional<Event> end;      // none: the record ends while the plate moves
  double last_time = 0;          // s, the end or the last sample
  std::vector<double> distance;  // m, of every sample, 0 where the plate stood before the start
};

Sliding find_sliding(const LoggerRecord& logger, const Settings& settings);

}  // namespace pulvis::lab
