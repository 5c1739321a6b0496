#include "engine/files/history_csv.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <iterator>
#include <span>
#include <utility>

#include "engine/files/own_files.hpp"

namespace pulvis {

HistoryCsv::HistoryCsv(std::filesystem::path path, const SeriesInfo& abscissa,
                       const std::vector<SeriesInfo>& series)
    : path_(std::move(path)) {
  std::string header = abscissa.name + " [" + abscissa.unit + "]";
  for (const auto& one : series) header += "," + one.name + " [" + one.unit + "]";
  header += "\n";
  file_.reset(std::fopen(begin_own(path_, role::run, header).c_str(), "wb"));
  if (!file_) fail("create the file");
  write(header);
  if (std::fflush(file_.get()) != 0) fail("flush the file");
  end_own(path_, role::run, header, Extent::start);
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

// If the file was deleted or replaced meanwhile, lines would be written that nobody will ever read.
void HistoryCsv::require_name() const {
  struct stat own {
  }, named{};
  if (fstat(fileno(file_.get()), &own) != 0) fail("examine the file");
  const bool there = stat(path_.c_str(), &named) == 0;
  if (there && own.st_dev == named.st_dev && own.st_ino == named.st_ino) return;
  throw OutputError(path_, "continue the file",
                    there ? "another file took its place" : "it is no longer there");
}

void HistoryCsv::close() {
  if (!file_) return;
  flush();
  if (std::fclose(file_.release()) != 0) fail("close the file");
  note_own(path_, role::run, checksum_.value(), bytes_);
}

void HistoryCsv::write(const std::string& line) {
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size()) fail("write a line");
  checksum_.add(std::as_bytes(std::span(line)));
  bytes_ += line.size();
}

void HistoryCsv::fail(const std::string& operation) const {
  throw OutputError(path_, operation, std::strerror(errno));
}

}  // namespace pulvis
