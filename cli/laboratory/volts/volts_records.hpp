// AFM records in volts, as exported by its software (CSV).
//
// Force curves   `displacement` of the piezo and `normal` volts, in the order of measurement: towards the
//                surface, then back; optionally `lateral` volts. A column `curve`, if present, numbers
//                the curve that each row belongs to.
// Side contacts  `displacement` along the sample and `lateral` volts, likewise; the retrace may be missing.
// Loops          as in cli/laboratory/wedge_records.hpp, but `load` in volts above the free level or in
//                newtons, `slope` only on a wedge, and optionally the normal volts of raw traces (normal_trace,
//                normal_retrace, above the free level)
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cli/laboratory/volts/force_curve.hpp"

namespace pulvis::volts {

// `signal`: the column used as the curve's normal signal.
std::vector<ForceCurve> read_curves(const std::filesystem::path& file, const char* signal);

struct Traces {
  std::vector<double> position;  // m; the index of the position where the file has none
  std::vector<double> trace, retrace;
};

struct VoltsLoop {
  double slope = 0;                                      // rad
  double load = 0;                                       // V or N
  double half_width = 0, offset = 0;                     // V
  std::optional<double> half_width_error, offset_error;  // V
  double normal_half = 0;             // V, half the difference of the normal signal
  std::optional<double> normal_mean;  // V
  Traces traces;                      // of raw loops
};

struct LoopRecord {
  std::filesystem::path file;
  bool load_in_volts = true;
  bool has_positions = false;
  std::vector<VoltsLoop> loops;
};

// `on_slopes`: the column `slope` is required; otherwise it must be absent. `skip`: share of a raw trace left
// out at each end. Throws SceneError with file, line and what is allowed.
LoopRecord read_loops(const std::filesystem::path& file, bool on_slopes, double skip);

}  // namespace pulvis::volts
