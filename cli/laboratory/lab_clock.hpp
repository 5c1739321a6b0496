// Synchronises the records of press and data logger.
//
// Both instruments see the plate start and stop: the logger's LVDT bends there, and so does the punch
// displacement, because the compact settles further while it is sheared (thesis, 3.3.4). The start
// gives the offset between the clocks, the stop their rate. The start of loading is of no use: the
// logger is switched on after it (3.3.1, step 4).
//
// The start in the press's record is first located where the plate's travel, shifted in time, explains
// the punch displacement best, on top of a + b t + c ln(1 + t/1 s) for creep under the held force. In
// a window around that, two lines are fitted to the punch displacement (lab_fit.hpp), crossing at
// the start, whose standard uncertainty is that of the offset, together with the LVDT's. The end of
// sliding is found in the same way. If the rate that follows from both exceeds three times its
// uncertainties it is applied; otherwise the clocks are assumed to run alike; the offset is the mean
// of those at start and end, weighted by their uncertainties;
// that at the end includes a drift of up to clock.largest_drift, uniformly distributed.
#pragma once

#include "cli/laboratory/lab_record.hpp"
#include "cli/laboratory/lab_sliding.hpp"
#include "scenes/solve/lab_fit.hpp"

#include <optional>

namespace pulvis::lab {

// The longest time during which the press held its force.
Samples find_hold(const PressRecord& press, double tolerance);

struct Clocks {
  bool is_given = false;  // the offset was given by the user
  Event press_start, logger_start;
  double offset = 0;              // s, press minus logger, when sliding starts
  double offset_uncertainty = 0;  // s, one standard deviation; 0 where the offset is given
  std::optional<double> drift;    // -, seconds gained by the press's clock per logger second
  double drift_uncertainty = 0;   // -, one standard deviation
  bool is_drift_applied = false;

  double press_time(double logger_time) const {
    return press_start.time +
           (logger_time - logger_start.time) * (is_drift_applied ? 1 + *drift : 1.0);
  }
};

// Rejected: no overlap, no visible start in the press's record, clocks whose rates differ too much.
Clocks match_clocks(const PressRecord& press, const LoggerRecord& logger, const Sliding& sliding,
                    const ClockSpec& spec, double hold_tolerance, std::optional<double> offset);

}  // namespace pulvis::lab
