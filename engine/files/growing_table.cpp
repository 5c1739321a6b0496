#include "engine/files/growing_table.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "engine/files/describe.hpp"
#include "engine/files/output_error.hpp"

namespace pulvis {

GrowingTable::GrowingTable(TableInfo info) : info_(std::move(info)), waiting_(columns()) {
  if (waiting_.empty()) throw std::invalid_argument("table " + info_.name + " has no columns");
}

void GrowingTable::add(std::span<const double> row) {
  if (row.size() != columns())
    throw std::invalid_argument("a row of table " + info_.name + " holds one value a column");
  for (std::size_t i = 0; i < row.size(); ++i) waiting_[i].push_back(row[i]);
}

void GrowingTable::write(hdf5::File& file, const std::string& group) const {
  for (std::size_t i = 0; i < columns(); ++i) {
    const SeriesInfo& column = info_.columns[i];
    const std::string dataset = group + "/" + column.name;
    file.write_series(dataset, this->group() + "/" + column.name,
                      static_cast<std::uint64_t>(written_), waiting_[i],
                      column.whole ? hdf5::Stored::whole : hdf5::Stored::real);
    describe(file, dataset, column.unit, column.meaning, column.label);
  }
}

void GrowingTable::renew(hdf5::File& file) {
  write(file, group() + ".next");
  written_ += waiting();
  for (std::vector<double>& values : waiting_) values.clear();
}

void GrowingTable::cut(hdf5::File& file, std::int64_t rows) {
  const std::uint64_t there = file.shape(group() + "/" + info_.columns.front().name).front();
  if (there < static_cast<std::uint64_t>(rows))
    throw OutputError(file.path(), "continue",
                      fmt::format("rows of {} are missing: {} are present, {} had been written",
                                  group(), there, rows));
  written_ = rows;
  renew(file);
}

std::vector<GrowingTable> growing_tables(std::vector<TableInfo> infos) {
  std::vector<GrowingTable> tables;
  for (TableInfo& info : infos) tables.emplace_back(std::move(info));
  return tables;
}

}  // namespace pulvis
