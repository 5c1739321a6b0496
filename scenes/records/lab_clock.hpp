// Brings the records of press and data logger to one clock.
//
// Both instruments see the plate start and stop: the logger's LVDT bends there, and so does the punch
// displacement, because the compact settles further while it is sheared (thesis, 3.3.4). The start
// gives the offset between the clocks, the stop their rate. The start of loading cannot serve: the
// logger is switched on after it (3.3.1, step 4).
//
// Roughly, the start in the press's record is where the plate's travel, shifted in time, explains the
// punch displacement best, beside a + b t + c ln(1 + t/1 s) for creep under the held force. Within a
// window around that, two lines are fitted to the punch displacement (lab_fit.hpp): their crossing is
// the start, and its standard uncertainty that of the offset, together with the LVDT's. The end of
// sliding is found in the same way. Where the rate that follows from both is larger than three of its
// uncertainties it is applied; otherwise the clocks are taken to run alike, and the offset is the mean
// of those at start and end, weighted by their uncertainties;
// that at the end includes a drift of up to clock.largest_drift, evenly distributed.
#pragma once

#include "scenes/lever/lab_fit.hpp"
#include "scenes/records/lab_record.hpp"
#include "scenes/records/lab_sliding.hpp"

#include <optional>

namespace pulvis::lab {

// The longest time that the press held its force.
Samples find_hold(const PressRecord& press, double tolerance);

struct Clocks {
  bool is_given = false;  // the offset is the user's
  Event press_start, logger_start;
  double offset = 0;              // s, press less logger, when sliding starts
  double offset_uncertainty = 0;  // s, one standard deviation; 0 where the offset is given
  std::optional<double> drift;    // -, seconds gained by the press's clock a second of the logger's
  double drift_uncertainty = 0;   // -, one standard deviation
  bool is_drift_applied = false;

  double press_time(double logger_time) const {
    return press_start.time +
           (logger_time - logger_start.time) * (is_drift_applied ? 1 + *drift : 1.0);
  }
};

// Refused: no overlap, no start to be seen in the press's record, clocks whose rates differ too much.
Clocks match_clocks(const PressRecord& press, const LoggerRecord& logger, const Sliding& sliding,
                    const ClockSpec& spec, double hold_tolerance, std::optional<double> offset);

}  // namespace pulvis::lab
