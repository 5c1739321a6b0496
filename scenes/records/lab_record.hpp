// Raw records of one sliding-plate test: the press's and the data logger's, each on its own clock.
//
// Refused, with file and line: missing columns, wrong units, cells without a number, time that does not
// grow, gaps, and channels at their limit. A channel whose limit nobody knows is taken as saturated
// where it shows noise at first and later repeats its largest or smallest value ten times running.
#pragma once

#include "scenes/records/lab_settings.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace pulvis::lab {

struct Record {
  std::filesystem::path file;
  std::vector<int> lines;    // of each sample
  std::vector<double> time;  // s, strictly growing
  double interval = 0;       // s, median time between samples
};

struct PressRecord : Record {
  std::vector<double> force;         // N, pressing is positive
  std::vector<double> displacement;  // m, into the die is positive
};

// Of an instrumented die; `force` is that on the top punch.
struct DieRecord : PressRecord {
  std::vector<double> bottom;  // N, pressing is positive
  std::vector<double> radial;  // Pa, likewise
};

struct LoggerRecord : Record {
  std::vector<double> strain;  // -
  std::vector<double> lvdt;    // V
};

enum class Instrument { press, logger };

// Which instrument wrote a file, from the names of its columns.
Instrument instrument_of(const std::filesystem::path& file, const Settings& settings);

PressRecord read_press(const std::filesystem::path& file, const Settings& settings);
DieRecord read_die(const std::filesystem::path& file, const Settings& settings);
LoggerRecord read_logger(const std::filesystem::path& file, const Settings& settings);

// What is wrong with a record at one of its samples, or as a whole (line 1).
[[noreturn]] void refuse(const Record& record, std::size_t sample, const std::string& key,
                         const std::string& message);
[[noreturn]] void refuse(const Record& record, const std::string& key, const std::string& message);

}  // namespace pulvis::lab
