#include "engine/world.hpp"

#include <algorithm>

namespace pulvis {

Buffer::Buffer(std::size_t bytes) : bytes_(bytes) {
  // A little more than asked for, so that an empty table still has an address to point at.
  const std::size_t rounded = (bytes + 64) / 64 * 64;
  data_.reset(static_cast<std::byte*>(::operator new[](rounded, std::align_val_t{64})));
  std::memset(data_.get(), 0, rounded);
}

void ColumnBase::rebuild(const std::vector<std::int32_t>& sources) {
  Buffer next(sources.size() * row_bytes);
  for (std::size_t row = 0; row < sources.size(); ++row) {
    if (sources[row] < 0) continue;
    const std::byte* from = buffer_.data() + static_cast<std::size_t>(sources[row]) * row_bytes;
    std::copy_n(from, row_bytes, next.data() + row * row_bytes);
  }
  buffer_ = std::move(next);
}

Table& World::insert_table(TypeKey key, Table table) {
  if (!table.chunk_begin.empty()) {
    const int chunks = static_cast<int>(table.chunk_begin.size()) - 1;
    if (chunks_ != 0 && chunks != chunks_)
      throw std::logic_error("table '" + table.place +
                             "' is divided into another number of chunks");
    chunks_ = chunks;
  }
  auto [place, inserted] = tables_.emplace(key, std::make_unique<Table>(std::move(table)));
  if (!inserted) throw std::logic_error("table '" + place->second->place + "' was added twice");
  return *place->second;
}

}  // namespace pulvis
