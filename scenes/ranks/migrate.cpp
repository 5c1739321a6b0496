#include "scenes/ranks/migrate.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "components/cell.hpp"
#include "components/contact.hpp"
#include "components/ranks.hpp"
#include "components/run_state.hpp"
#include "components/space/contact.hpp"
#include "components/space/tools.hpp"
#include "scenes/ranks/columns.hpp"
#include "systems/ranks/restore.hpp"

namespace pulvis {
namespace {

void append(Ranks::Bytes& bytes, std::span<const std::byte> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

class Migration {
 public:
  Migration(World& share, const std::vector<int>& owner)
      : share_(share),
        link_(share.resource<RankLink>()),
        bodies_(share.resource<Bodies>()),
        ranks_(*link_.ranks),
        owner_(owner) {}

  void column(ColumnBase& column) const;
  void drop_others(ColumnBase& column) const;
  void rows(const char* entity) const;
  void neighbours() const;

 private:
  // [ranks] rows of this rank, in the order of their slots.
  using RowsOfRanks = std::vector<std::vector<std::int32_t>>;

  std::size_t count() const { return static_cast<std::size_t>(ranks_.count()); }
  int new_owner(int slot) const { return entry(owner_, slot / lane_count); }
  RowsOfRanks rows_of_ranks(const char* entity) const;
  std::vector<std::byte> exchanged(const ColumnBase& column, const RowsOfRanks& rows) const;
  std::vector<std::int32_t> exchanged_triangles(const RowsOfRanks& rows) const;
  const std::vector<std::int32_t>& begin_of(const char* entity) const {
    const ContactIndex& index = share_.resource<ContactIndex>();
    return is_with_tools(entity) ? index.tool_begin : index.sampled_begin;
  }

  World& share_;
  const RankLink& link_;
  const Bodies& bodies_;
  Ranks& ranks_;
  const std::vector<int>& owner_;
};

// ---- data divided by chunks -------------------------------------------------------------------------
void Migration::column(ColumnBase& column) const {
  std::vector<Ranks::Bytes> to(count());
  for (const int chunk : bodies_.own_chunks)
    if (const int taker = entry(owner_, chunk); taker != ranks_.rank())
      append(to[static_cast<std::size_t>(taker)], column.of_chunk(chunk));
  const std::vector<Ranks::Bytes> from = ranks_.all_to_all(std::move(to));
  std::vector<std::size_t> at(count());
  for (int chunk = 0; chunk < bodies_.chunks(); ++chunk) {
    const int giver = entry(link_.owner, chunk);
    if (giver == ranks_.rank() || entry(owner_, chunk) != ranks_.rank()) continue;
    const std::span<const std::byte> rows = column.of_chunk(chunk);
    const auto rank = static_cast<std::size_t>(giver);
    if (rows.empty()) continue;
    std::memcpy(column.data() + (rows.data() - column.data()), from[rank].data() + at[rank],
                rows.size());
    at[rank] += rows.size();
  }
}

// Frees the rows of chunks that other ranks own. Columns of particles themselves are held in full by all ranks.
void Migration::drop_others(ColumnBase& column) const {
  if (column.entity == Particle::name) return;
  const std::vector<std::int32_t>& begin = column.owner().chunk_begin;
  for (std::size_t first = 0; first < owner_.size();) {
    std::size_t end = first;
    while (end < owner_.size() && owner_[end] != ranks_.rank()) ++end;
    if (end > first)
      column.drop(static_cast<std::size_t>(begin[first]),
                  static_cast<std::size_t>(begin[end] - begin[first]));
    first = end + 1;
  }
}

// ---- contact rows -----------------------------------------------------------------------------------
// Rows computed here are sent to the rank that will compute them, and to the one that will own the other particle.
Migration::RowsOfRanks Migration::rows_of_ranks(const char* entity) const {
  const std::vector<std::int32_t>& begin = begin_of(entity);
  const std::span<const std::int32_t> keys = keys_of(share_, entity);
  RowsOfRanks rows(count());
  bodies_.for_own_lanes([&](int slot) {
    const int taker = new_owner(slot);
    for (int r = entry(begin, slot); r < entry(begin, slot + 1); ++r) {
      entry(rows, taker).push_back(r);
      if (is_with_tools(entity)) continue;
      const int other = new_owner(keys[3 * static_cast<std::size_t>(r) + 2]);
      if (other != taker) entry(rows, other).push_back(r);
    }
  });
  return rows;
}

// What all ranks send to this one, rank by rank.
std::vector<std::byte> Migration::exchanged(const ColumnBase& column,
                                            const RowsOfRanks& rows) const {
  std::vector<Ranks::Bytes> to(count());
  for (std::size_t rank = 0; rank < rows.size(); ++rank)
    for (const std::int32_t r : rows[rank])
      append(to[rank],
             rows_of(column, static_cast<std::size_t>(r), static_cast<std::size_t>(r) + 1));
  Ranks::Bytes all;
  for (const Ranks::Bytes& bytes : ranks_.all_to_all(std::move(to))) append(all, bytes);
  return all;
}

std::vector<std::int32_t> Migration::exchanged_triangles(const RowsOfRanks& rows) const {
  const auto& lists = share_.resource<space::TriangleLists>();
  const std::int32_t* range = share_.column<space::TriangleRange>().values();
  std::vector<Ranks::Bytes> to(count());
  for (std::size_t rank = 0; rank < rows.size(); ++rank) {
    std::vector<std::int32_t> listed;
    for (const std::int32_t r : rows[rank]) lists.append(range + 2 * r, listed);
    append(to[rank], bytes_of(listed));
  }
  Ranks::Bytes all;
  for (const Ranks::Bytes& bytes : ranks_.all_to_all(std::move(to))) append(all, bytes);
  return list_in<std::int32_t>(all);
}

// Sorts by slot: the rows of a slot come from one rank, and keep their order.
std::vector<std::int32_t> order_of(std::span<const std::int32_t> keys) {
  std::vector<std::int32_t> order(keys.size() / 3);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {},
                           [&](std::int32_t r) { return keys[3 * static_cast<std::size_t>(r)]; });
  return order;
}

std::vector<std::byte> in_order(const std::vector<std::byte>& rows, std::size_t row_bytes,
                                const std::vector<std::int32_t>& order) {
  std::vector<std::byte> sorted(rows.size());
  for (std::size_t r = 0; r < order.size(); ++r)
    std::memcpy(&sorted[r * row_bytes], &rows[static_cast<std::size_t>(order[r]) * row_bytes],
                row_bytes);
  return sorted;
}

// `range`: in the order received; the triangles are put into the same order as the sorted rows.
std::vector<std::int32_t> triangles_in_order(std::vector<std::int32_t> range,
                                             std::vector<std::int32_t> triangles,
                                             const std::vector<std::int32_t>& order) {
  space::TriangleLists::make_consecutive(range);
  const space::TriangleLists lists{std::move(triangles)};
  std::vector<std::int32_t> sorted;
  for (const std::int32_t r : order) lists.append(&range[2 * static_cast<std::size_t>(r)], sorted);
  return sorted;
}

void Migration::rows(const char* entity) const {
  std::vector<const ColumnBase*> columns;
  for (const ColumnBase* column : share_.columns())
    if (is_of_rows(*column, entity) && !column->declared_transient) columns.push_back(column);
  if (columns.empty() || begin_of(entity).empty()) return;
  const RowsOfRanks given = rows_of_ranks(entity);
  const std::string keys = ContactPair<Contact>::info.name;
  std::partition(columns.begin(), columns.end(),
                 [&](const ColumnBase* c) { return c->info.name == keys; });
  const ColumnBase* ranges = nullptr;  // of triangles
  std::vector<std::int32_t> triangles, order;
  if (share_.has<space::TriangleLists>() && entity == std::string(FaceToolContact::name)) {
    ranges = &share_.column<space::TriangleRange>();
    triangles = exchanged_triangles(given);
  }
  for (const ColumnBase* column : columns) {
    const std::vector<std::byte> taken = exchanged(*column, given);
    if (column == columns.front()) order = order_of(list_in<std::int32_t>(taken));
    if (column == ranges)
      triangles = triangles_in_order(list_in<std::int32_t>(taken), std::move(triangles), order);
    share_.set_column(*column, in_order(taken, column->row_bytes, order));
  }
  ContactIndex& index = share_.resource<ContactIndex>();
  (is_with_tools(entity) ? index.tool_begin : index.sampled_begin) =
      begins_of(keys_of(share_, entity), bodies_.slots.size());
  if (ranges == nullptr) return;
  auto& range = share_.column<space::TriangleRange>();
  space::TriangleLists::make_consecutive({range.values(), 2 * range.table.rows});
  share_.resource<space::TriangleLists>().triangles = std::move(triangles);
}

// Neighbours found by the broad phase: slot, count, neighbours, and in a periodic cell their images.
void Migration::neighbours() const {
  ContactIndex& index = share_.resource<ContactIndex>();
  if (index.neighbour_begin.empty()) return;
  const std::size_t axes = cell_axes(share_);
  std::vector<Ranks::Bytes> to(count());
  bodies_.for_own_lanes([&](int slot) {
    const auto first = static_cast<std::size_t>(entry(index.neighbour_begin, slot)),
               size = static_cast<std::size_t>(entry(index.neighbour_begin, slot + 1)) - first;
    const std::int32_t head[] = {slot, static_cast<std::int32_t>(size)};
    Ranks::Bytes& bytes = entry(to, new_owner(slot));
    append(bytes, std::as_bytes(std::span(head)));
    append(bytes, std::as_bytes(std::span(index.neighbours).subspan(first, size)));
    if (axes > 0)
      append(bytes, std::as_bytes(std::span(index.images).subspan(axes * first, axes * size)));
  });
  std::vector<std::vector<std::int32_t>> messages;
  for (const Ranks::Bytes& bytes : ranks_.all_to_all(std::move(to)))
    messages.push_back(list_in<std::int32_t>(bytes));
  std::vector<std::span<const std::int32_t>> of_slot(bodies_.slots.size());
  for (const std::vector<std::int32_t>& message : messages)
    for (std::span<const std::int32_t> left(message); !left.empty();) {
      const auto size = static_cast<std::size_t>(left[1]) * (1 + axes);
      entry(of_slot, left[0]) = left.subspan(2, size);
      left = left.subspan(2 + size);
    }
  index.neighbour_begin.assign(1, 0);
  index.neighbours.clear();
  index.images.clear();
  for (const std::span<const std::int32_t> of : of_slot) {
    const std::size_t size = of.size() / (1 + axes);
    index.neighbours.insert(index.neighbours.end(), of.begin(),
                            of.begin() + static_cast<std::ptrdiff_t>(size));
    index.images.insert(index.images.end(), of.begin() + static_cast<std::ptrdiff_t>(size),
                        of.end());
    index.neighbour_begin.push_back(static_cast<std::int32_t>(index.neighbours.size()));
  }
}

}  // namespace

void migrate(World& share, const std::vector<int>& owner) {
  await_outlines(share);
  RankLink& link = share.resource<RankLink>();
  std::vector<bool> owns;
  for (const int rank : owner) owns.push_back(rank == link.ranks->rank());
  share.hold(owns);
  const Migration all(share, owner);
  for (std::size_t i = 0; i < share.columns().size(); ++i) {
    ColumnBase& column = same_column(share, i);
    if (!is_by_chunk(column)) continue;
    if (!column.declared_transient) all.column(column);
    all.drop_others(column);
  }
  const bool touching = share.has<ContactIndex>();
  if (touching) {
    for (const char* entity : row_entities) all.rows(entity);
    all.neighbours();
  }
  link.owner = owner;
  share.resource<Bodies>().hold(owns);
  if (!touching) return;
  list_rows(share);
  find_border_again(share);
}

}  // namespace pulvis
