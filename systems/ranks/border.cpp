#include "systems/ranks/border.hpp"

#include <cstring>

namespace pulvis {

Ranks::Bytes packed(std::span<const int> slots, std::span<const Outlines> columns) {
  Ranks::Bytes bytes;
  for (const Outlines& column : columns)
    for (const int slot : slots) {
      const std::span<const std::byte> of = std::as_bytes(column.of(slot));
      bytes.insert(bytes.end(), of.begin(), of.end());
    }
  return bytes;
}

void unpack(std::span<const std::byte> bytes, std::span<const int> slots,
            std::span<const Outlines> columns) {
  for (const Outlines& column : columns)
    for (const int slot : slots) {
      const std::span<std::byte> of = std::as_writable_bytes(column.of(slot));
      std::memcpy(of.data(), bytes.data(), of.size());
      bytes = bytes.subspan(of.size());
    }
}

Ranks::Bytes bytes_of_slots(const std::vector<int>& slots) {
  const auto bytes = std::as_bytes(std::span(slots));
  return {bytes.begin(), bytes.end()};
}
std::vector<int> slots_in(const Ranks::Bytes& bytes) {
  std::vector<int> slots(bytes.size() / sizeof(int));
  if (!slots.empty()) std::memcpy(slots.data(), bytes.data(), bytes.size());
  return slots;
}

void tell_border(RankLink& own, std::span<const Outlines> columns) {
  std::vector<Ranks::Bytes> to(static_cast<std::size_t>(own.ranks->count()));
  for (const RankLink::Neighbour& near : own.border)
    to[static_cast<std::size_t>(near.rank)] = packed(near.send, columns);
  const std::vector<Ranks::Bytes> from = own.ranks->all_to_all(std::move(to));
  for (const RankLink::Neighbour& near : own.border)
    unpack(from[static_cast<std::size_t>(near.rank)], near.receive, columns);
}

}  // namespace pulvis
