// A table of run.h5 that grows by rows: a group of 1-D datasets, one per column. New rows wait in memory until the
// whole table is rewritten next to the old one, which it then replaces (see engine/files/recorder.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/files/hdf5.hpp"
#include "engine/files/record.hpp"

namespace pulvis {

class GrowingTable {
 public:
  explicit GrowingTable(TableInfo info);

  std::string group() const { return "/" + info_.name; }
  std::size_t columns() const { return info_.columns.size(); }
  std::int64_t written() const { return written_; }  // rows in the file
  std::int64_t waiting() const { return static_cast<std::int64_t>(waiting_.front().size()); }
  bool has_news() const { return waiting() > 0; }

  void add(std::span<const double> row);
  // Creates the table in a new file, without rows.
  void make(hdf5::File& file) const { write(file, group()); }
  // Rewrites the table, including the waiting rows, as group() + ".next".
  void renew(hdf5::File& file);
  // The same with only the first `rows` rows written by an earlier program.
  void cut(hdf5::File& file, std::int64_t rows);

 private:
  void write(hdf5::File& file, const std::string& group) const;

  TableInfo info_;
  std::vector<std::vector<double>> waiting_;  // [column][row]
  std::int64_t written_ = 0;
};

std::vector<GrowingTable> growing_tables(std::vector<TableInfo> infos);

}  // namespace pulvis
