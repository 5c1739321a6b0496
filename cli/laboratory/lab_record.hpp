// Raw records of one sliding-plate test: from the press and the data logger, each on its own clock.
//
// Rejected, with file and line: missing columns, wrong units, non-numeric cells, time that does not
// increase, gaps, and channels at their limit. A channel of unknown limit is assumed saturated
// where it shows noise at first and later repeats its largest or smallest value ten times in a row.
#pragma once

#include "cli/laboratory/lab_settings.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace pulvis::lab {

struct Record {
  std::filesystem::path file;
  std::vector<int> lines;    // of each sample
  std::vector<double> time;  // s, strictly increasing
  double interval = 0;       // s, median time between samples
};

struct PressRecord : Record {
  std::vector<double> force;         // N, compression is positive
  std::vector<double> displacement;  // m, into the die is positive
};

// From an instrumented die; `force` is that on the top punch.
struct DieRecord : PressRecord {
  std::vector<double> bottom;  // N, compression is positive
  std::vector<double> radial;  // Pa, compression is positive
};

struct LoggerRecord : Record {
  std::vector<double> strain;  // -
  std::vector<double> lvdt;    // V
};

enum class Instrument { press, logger };

// Identifies the instrument that wrote a file from its column names.
Instrument instrument_of(const std::filesystem::path& file, const Settings& settings);

PressRecord read_press(const std::filesystem::path& file, const Settings& settings);
DieRecord read_die(const std::filesystem::path& file, const Settings& settings);
LoggerRecord read_logger(const std::filesystem::path& file, const Settings& settings);

// Reports what is wrong with a record at one of its samples, or as a whole (line 1).
[[noreturn]] void refuse(const Record& record, std::size_t sample, const std::string& key,
                         const std::string& message);
[[noreturn]] void refuse(const Record& record, const std::string& key, const std::string& message);

}  // namespace pulvis::lab
