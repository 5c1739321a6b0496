// How ranks exchange the outlines of particles.
#pragma once

#include <span>
#include <vector>

#include "components/shape.hpp"
#include "systems/ranks/reduce.hpp"

namespace pulvis {

// A column of outlines, stored by particle: control points in two dimensions, Bezier points and faces in three.
class Outlines {
 public:
  template <class C>
  Outlines(const Write<C>& column)
      : table_(column.table()), values_(column.values()), numbers_(C::count) {}
  std::span<double> of(int slot) const {
    const auto chunk = static_cast<std::size_t>(slot / lane_count);
    const auto rows = static_cast<std::size_t>(
        (table_.chunk_begin[chunk + 1] - table_.chunk_begin[chunk]) / lane_count);
    const auto first = static_cast<std::size_t>(first_row(table_, slot));
    return values_.subspan(first * numbers_, rows * numbers_);
  }

 private:
  const Table& table_;
  std::span<double> values_;
  std::size_t numbers_;
};

// Packs the outlines of `slots` from all columns, one after the other, and unpacks them.
Ranks::Bytes packed(std::span<const int> slots, std::span<const Outlines> columns);
void unpack(std::span<const std::byte> bytes, std::span<const int> slots,
            std::span<const Outlines> columns);

// Slots to a message, and back.
Ranks::Bytes bytes_of_slots(const std::vector<int>& slots);
std::vector<int> slots_in(const Ranks::Bytes& bytes);

// Exchanges the whole border at once; does nothing if the run has one process.
void tell_border(RankLink& link, std::span<const Outlines> columns);
inline void tell_border(RankLink& link, const Outlines& column) {
  tell_border(link, std::span(&column, 1));
}
template <class Position>
void tell_border(const Optional<BorderOutlines<Position>>& border) {
  if (border) tell_border(*border->link, Outlines(border->outlines));
}

}  // namespace pulvis
