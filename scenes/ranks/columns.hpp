// What is sent from rank to rank: rows of columns as bytes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "components/contact.hpp"
#include "engine/world.hpp"

namespace pulvis {

// Kinds of entities whose rows are ordered by their particles' slots, and are not divided by chunks.
inline constexpr const char* row_entities[] = {Contact::name, ToolContact::name, FaceContact::name,
                                               FaceToolContact::name};
inline bool is_with_tools(const std::string& entity) {
  return entity == ToolContact::name || entity == FaceToolContact::name;
}

inline bool is_by_chunk(const ColumnBase& column) { return !column.owner().chunk_begin.empty(); }
inline bool is_of_rows(const ColumnBase& column, const char* entity) {
  return column.entity == entity;
}
inline bool is_of_contacts(const ColumnBase& column) {
  return std::ranges::any_of(row_entities,
                             [&](const char* entity) { return is_of_rows(column, entity); });
}

inline ColumnBase& same_column(World& world, std::size_t number) {
  return const_cast<ColumnBase&>(*world.columns()[number]);
}

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& list) {
  return std::as_bytes(std::span(list));
}
template <class T>
std::vector<T> list_in(std::span<const std::byte> bytes) {
  std::vector<T> list(bytes.size() / sizeof(T));
  if (!list.empty()) std::memcpy(list.data(), bytes.data(), list.size() * sizeof(T));
  return list;
}

inline std::span<const std::byte> rows_of(const ColumnBase& column, std::size_t first,
                                          std::size_t last) {
  return {column.data() + first * column.row_bytes, (last - first) * column.row_bytes};
}

// First contact row of every slot, of one kind of rows, in this process: [slots + 1].
std::vector<std::int32_t> row_begins_in(const World& world, const std::string& entity);
// The part of a column that belongs to a chunk. `begin`: first row of every slot, for contact rows.
std::span<const std::byte> rows_of_chunk(const ColumnBase& column, int chunk,
                                         const std::vector<std::int32_t>& begin);

// Slot, edge or face, other of every row; empty if the world has no such rows.
std::span<const std::int32_t> keys_of(const World& world, const char* entity);
// Computes from them where the rows of every slot begin: [slots + 1].
std::vector<std::int32_t> begins_of(std::span<const std::int32_t> keys, std::size_t slots);

}  // namespace pulvis
