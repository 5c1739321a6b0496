#include "engine/history_csv.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

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
  require_name();
}

// What was deleted or replaced meanwhile would go on taking lines that nobody will ever read.
void HistoryCsv::require_name() const {
  struct stat own {
  }, named{};
  if (fstat(fileno(file_.get()), &own) != 0) fail("look at the file");
  const bool there = stat(path_.c_str(), &named) == 0;
  if (there && own.st_dev == named.st_dev && own.st_ino == named.st_ino) return;
  throw OutputError(path_, "go on with the file",
                    there ? "another file took its place" : "it was deleted during the run");
}

void HistoryCsv::close() {
  if (file_) flush();
  if (file_ && std::fclose(file_.release()) != 0) fail("close the file");
}

void HistoryCsv::write(const std::string& line) {
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size()) fail("write a line");
}

void HistoryCsv::fail(const std::string& operation) const {
  throw OutputError(path_, operation, std::strerror(errno));
}

}  // namespace pulvis
