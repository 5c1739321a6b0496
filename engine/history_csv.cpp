#include "engine/history_csv.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <iterator>
#include <utility>

#include "engine/output_error.hpp"

namespace pulvis {

HistoryCsv::HistoryCsv(std::filesystem::path path, const SeriesInfo& abscissa,
                       const std::vector<SeriesInfo>& series)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wb")) {
  if (!file_) fail("create the file");
  std::string header = abscissa.name + " [" + abscissa.unit + "]";
  for (const auto& one : series) header += "," + one.name + " [" + one.unit + "]";
  write(header + "\n");
}

void HistoryCsv::add(double time, std::span<const double> values) {
  std::string line = fmt::format("{:.17g}", time);
  for (const double value : values) fmt::format_to(std::back_inserter(line), ",{:.17g}", value);
  write(line + "\n");
}

void HistoryCsv::flush() {
  if (std::fflush(file_.get()) != 0) fail("flush the file");
}

void HistoryCsv::close() {
  if (file_ && std::fclose(file_.release()) != 0) fail("close the file");
}

void HistoryCsv::write(const std::string& line) {
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size()) fail("write a line");
}

void HistoryCsv::fail(const std::string& operation) const {
  throw OutputError(path_, operation, std::strerror(errno));
}

}  // namespace pulvis
