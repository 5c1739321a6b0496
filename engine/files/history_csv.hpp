// history.csv: the history as a table for spreadsheets, with the same numbers as run.h5 (17
// digits, so that reading them back gives the same bits). First column: sampling variable; header
// "name [unit]".
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/files/record.hpp"
#include "engine/files/xxh3.hpp"

namespace pulvis {

class HistoryCsv {
 public:
  HistoryCsv(std::filesystem::path path, const SeriesInfo& abscissa,
             const std::vector<SeriesInfo>& series);
  void add(double time, std::span<const double> values);
  void flush();
  void close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void write(const std::string& line);
  void require_name() const;
  [[noreturn]] void fail(const std::string& operation) const;

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Closer> file_;
  Xxh3 checksum_;  // of the text written so far
  std::uint64_t bytes_ = 0;
};

}  // namespace pulvis
