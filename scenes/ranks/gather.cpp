#include "scenes/ranks/gather.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <set>
#include <string>

#include "components/cell.hpp"
#include "components/contact.hpp"
#include "components/ranks.hpp"
#include "components/run_state.hpp"
#include "components/space/contact.hpp"
#include "components/space/tools.hpp"
#include "scenes/ranks/columns.hpp"
#include "systems/ranks/border.hpp"
#include "systems/ranks/restore.hpp"

namespace pulvis {
namespace {

// Set by the step, or by the root when results are taken, and not identical on all ranks.
bool is_of_a_share(const std::string& resource) {
  static const std::set<std::string> own{"bodies",
                                         "rank_link",
                                         "contact_index",
                                         "contact_network",
                                         "density_grid",
                                         "force_chains",
                                         "fragments",
                                         "contact_sums",
                                         "tool_contact_sums",
                                         "contact_blocks",
                                         "tool_contact_blocks",
                                         "face_pairs",
                                         "face_tool_contact_blocks",
                                         "pair_loads",
                                         "triangle_lists",
                                         "bond_sums",
                                         "tool_bond_sums"};
  return own.contains(resource);
}

}  // namespace

Gatherer::Gatherer(World& share, World* whole)
    : share_(share), whole_(whole), ranks_(*share.resource<RankLink>().ranks) {}

// Joins the data of every chunk from all ranks, in chunk order; on the root.
std::vector<std::byte> Gatherer::joined(std::span<const std::byte> own,
                                        const std::vector<std::size_t>& bytes_of_chunk) {
  const std::vector<Ranks::Bytes> all = ranks_.gather(own);
  if (whole_ == nullptr) return {};
  const std::vector<int>& owner = share_.resource<RankLink>().owner;
  std::vector<std::byte> whole;
  whole.reserve(std::accumulate(bytes_of_chunk.begin(), bytes_of_chunk.end(), std::size_t{0}));
  std::vector<std::size_t> at(all.size());
  for (std::size_t chunk = 0; chunk < owner.size(); ++chunk) {
    const auto rank = static_cast<std::size_t>(owner[chunk]);
    const auto first = all[rank].begin() + static_cast<std::ptrdiff_t>(at[rank]);
    whole.insert(whole.end(), first, first + static_cast<std::ptrdiff_t>(bytes_of_chunk[chunk]));
    at[rank] += bytes_of_chunk[chunk];
  }
  return whole;
}

void Gatherer::column(std::size_t number) {
  const ColumnBase& own = *share_.columns()[number];
  const RowBegins begins = is_by_chunk(own) ? RowBegins{} : row_begins(own.entity);
  if (whole_ != nullptr && !is_by_chunk(own))
    whole_->room_for(*whole_->columns()[number], static_cast<std::size_t>(begins.whole.back()));
  // In parts, so that no rank holds a column twice.
  constexpr int at_once = 32;
  const int chunks = share_.resource<Bodies>().chunks();
  for (int first = 0; first < chunks; first += at_once)
    part_of_column(number, begins, first, std::min(first + at_once, chunks));
  // The ranges of a rank count from the start of its own list.
  if (whole_ != nullptr && share_.has<space::TriangleLists>() &&
      &own == &share_.column<space::TriangleRange>())
    space::TriangleLists::make_consecutive({whole_->column<space::TriangleRange>().values(),
                                            2 * static_cast<std::size_t>(begins.whole.back())});
}

void Gatherer::part_of_column(std::size_t number, const RowBegins& begins, int first, int last) {
  const ColumnBase& own = *share_.columns()[number];
  const std::vector<int>& owner = share_.resource<RankLink>().owner;
  std::vector<std::byte> bytes;
  for (int chunk = first; chunk < last; ++chunk) {
    if (entry(owner, chunk) != ranks_.rank()) continue;
    const std::span<const std::byte> rows = rows_of_chunk(own, chunk, begins.own);
    bytes.insert(bytes.end(), rows.begin(), rows.end());
  }
  const std::vector<Ranks::Bytes> all = ranks_.gather(bytes);
  if (whole_ == nullptr) return;
  ColumnBase& column = same_column(*whole_, number);
  std::vector<std::size_t> at(all.size());
  for (int chunk = first; chunk < last; ++chunk) {
    const auto rank = static_cast<std::size_t>(entry(owner, chunk));
    const std::span<const std::byte> rows = rows_of_chunk(column, chunk, begins.whole);
    if (rows.empty()) continue;
    std::memcpy(column.data() + (rows.data() - column.data()), all[rank].data() + at[rank],
                rows.size());
    at[rank] += rows.size();
  }
}

void Gatherer::particles(const ParticleValues& values, const ValueSink& take) {
  constexpr std::size_t at_once = 2048;
  const Bodies& bodies = share_.resource<Bodies>();
  const RankLink& link = share_.resource<RankLink>();
  std::span<const int> left = bodies.slot_of_number;
  while (!left.empty()) {
    const std::span<const int> slots = left.first(std::min(at_once, left.size()));
    left = left.subspan(slots.size());
    std::vector<double> own;
    std::vector<std::int32_t> counts;
    for (const int slot : slots) {
      if (!bodies.owns(slot)) continue;
      const std::size_t before = own.size();
      values(share_, slot, own);
      counts.push_back(static_cast<std::int32_t>(own.size() - before));
    }
    std::vector<std::vector<std::int32_t>> counts_of;
    std::vector<std::vector<double>> values_of;
    for (const Ranks::Bytes& bytes : ranks_.gather(bytes_of(counts)))
      counts_of.push_back(list_in<std::int32_t>(bytes));
    for (const Ranks::Bytes& bytes : ranks_.gather(bytes_of(own)))
      values_of.push_back(list_in<double>(bytes));
    if (whole_ == nullptr) continue;
    std::vector<std::size_t> particle(counts_of.size()), value(counts_of.size());
    for (const int slot : slots) {
      const auto rank = static_cast<std::size_t>(link.owner_of(slot));
      const auto count = static_cast<std::size_t>(counts_of[rank][particle[rank]++]);
      take(std::span<const double>(values_of[rank]).subspan(value[rank], count));
      value[rank] += count;
    }
  }
}

// First row of every slot: here, and on the root of the whole.
Gatherer::RowBegins Gatherer::row_begins(const std::string& entity) {
  const Bodies& bodies = share_.resource<Bodies>();
  RowBegins begins{row_begins_in(share_, entity), {}};
  std::vector<std::int32_t> counts;
  bodies.for_own_lanes(
      [&](int slot) { counts.push_back(entry(begins.own, slot + 1) - entry(begins.own, slot)); });
  const std::vector<std::byte> all =
      joined(bytes_of(counts), std::vector<std::size_t>(static_cast<std::size_t>(bodies.chunks()),
                                                        lane_count * sizeof(std::int32_t)));
  if (whole_ == nullptr) return begins;
  begins.whole.assign(1, 0);
  for (const std::int32_t count : list_in<std::int32_t>(all))
    begins.whole.push_back(begins.whole.back() + count);
  return begins;
}

void Gatherer::row_index() {
  if (!share_.has<ContactIndex>()) return;
  std::vector<std::int32_t> sampled_begin, tool_begin;
  for (const char* entity : row_entities) {
    const auto is_one = [&](const ColumnBase* column) { return is_of_rows(*column, entity); };
    if (std::ranges::none_of(share_.columns(), is_one)) continue;
    RowBegins begins = row_begins(entity);
    if (std::string(entity) == FaceToolContact::name) triangles(begins);
    (is_with_tools(entity) ? tool_begin : sampled_begin) = std::move(begins.whole);
  }
  if (whole_ != nullptr) {
    auto& index = whole_->resource<ContactIndex>();
    index = share_.resource<ContactIndex>();
    index.sampled_begin = sampled_begin;
    index.tool_begin = tool_begin;
    list_rows(*whole_);
  }
  neighbours();
}

// Triangles of mesh tools that the rows of all ranks can touch: every rank has a list for its own rows.
void Gatherer::triangles(const RowBegins& begins) {
  if (!share_.has<space::TriangleLists>()) return;
  const ColumnBase* ranges = &share_.column<space::TriangleRange>();
  column(static_cast<std::size_t>(std::ranges::find(share_.columns(), ranges) -
                                  share_.columns().begin()));
  const auto& lists = share_.resource<space::TriangleLists>();
  const std::int32_t* own = share_.column<space::TriangleRange>().values();
  std::vector<std::int32_t> listed;
  for (const int chunk : share_.resource<Bodies>().own_chunks)
    for (int r = entry(begins.own, chunk * lane_count);
         r < entry(begins.own, (chunk + 1) * lane_count); ++r)
      lists.append(own + 2 * r, listed);
  std::vector<std::size_t> bytes_of_chunk;
  const std::int32_t* whole =
      whole_ != nullptr ? whole_->column<space::TriangleRange>().values() : nullptr;
  for (std::size_t slot = lane_count; slot < begins.whole.size(); slot += lane_count) {
    std::size_t triangles = 0;
    for (int r = begins.whole[slot - lane_count]; r < begins.whole[slot]; ++r)
      triangles += static_cast<std::size_t>(whole[2 * r + 1] - whole[2 * r]);
    bytes_of_chunk.push_back(triangles * sizeof(std::int32_t));
  }
  const auto all = list_in<std::int32_t>(joined(bytes_of(listed), bytes_of_chunk));
  if (whole_ != nullptr) whole_->resource<space::TriangleLists>().triangles = all;
}

// Neighbours of all particles, as found by the broad phase.
void Gatherer::neighbours() {
  const ContactIndex& own = share_.resource<ContactIndex>();
  const Bodies& bodies = share_.resource<Bodies>();
  const std::size_t axes = cell_axes(share_);
  std::vector<std::int32_t> counts, slots, images;
  if (!own.neighbour_begin.empty())
    bodies.for_own_lanes([&](int slot) {
      const auto first = static_cast<std::size_t>(entry(own.neighbour_begin, slot)),
                 last = static_cast<std::size_t>(entry(own.neighbour_begin, slot + 1));
      counts.push_back(static_cast<std::int32_t>(last - first));
      for (std::size_t k = first; k < last; ++k) {
        slots.push_back(own.neighbours[k]);
        for (std::size_t i = 0; i < axes; ++i) images.push_back(own.images[axes * k + i]);
      }
    });
  else
    bodies.for_own_lanes([&](int) { counts.push_back(0); });
  const auto chunks = static_cast<std::size_t>(bodies.chunks());
  const std::vector<std::byte> all =
      joined(bytes_of(counts), std::vector<std::size_t>(chunks, lane_count * sizeof(std::int32_t)));
  const auto of_slot = list_in<std::int32_t>(all);
  std::vector<std::size_t> of_chunk(chunks), images_of_chunk(chunks);
  for (std::size_t slot = 0; slot < of_slot.size(); ++slot) {
    const auto count = static_cast<std::size_t>(of_slot[slot]);
    of_chunk[slot / lane_count] += count * sizeof(std::int32_t);
    images_of_chunk[slot / lane_count] += count * axes * sizeof(std::int32_t);
  }
  const auto whole_slots = list_in<std::int32_t>(joined(bytes_of(slots), of_chunk));
  const auto whole_images = list_in<std::int32_t>(joined(bytes_of(images), images_of_chunk));
  if (whole_ == nullptr) return;
  ContactIndex& index = whole_->resource<ContactIndex>();
  index.neighbours = whole_slots;
  index.images = whole_images;
  index.neighbour_begin.clear();
  if (own.neighbour_begin.empty()) return;
  index.neighbour_begin.assign(1, 0);
  for (const std::int32_t count : of_slot)
    index.neighbour_begin.push_back(index.neighbour_begin.back() + count);
}

void Gatherer::common() {
  if (whole_ == nullptr) return;
  for (std::size_t i = 0; i < share_.columns().size(); ++i) {
    const ColumnBase& column = *share_.columns()[i];
    if (column.entity == Tool::name)
      std::memcpy(same_column(*whole_, i).data(), column.data(), column.bytes());
  }
  for (const World::SavedResource& resource : whole_->saved_resources()) {
    if (is_of_a_share(resource.name)) continue;
    const auto own =
        std::ranges::find(share_.saved_resources(), resource.name, &World::SavedResource::name);
    resource.set_state(own->state());
  }
}

// ---- distributing a checkpoint --------------------------------------------------------------------
namespace {

// Rows that this rank computes, or whose other particle it owns.
std::vector<std::int32_t> rows_to_keep(const Bodies& bodies, std::span<const std::int32_t> keys,
                                       bool with_tools) {
  std::vector<std::int32_t> rows;
  for (std::size_t r = 0; 3 * r < keys.size(); ++r)
    if (bodies.owns(keys[3 * r]) || (!with_tools && bodies.owns(keys[3 * r + 2])))
      rows.push_back(static_cast<std::int32_t>(r));
  return rows;
}

void take_rows(const Checkpoint& checkpoint, World& share, const char* entity) {
  const std::string pair_column = std::string(entity) + "/pair";
  if (!checkpoint.has_column(pair_column)) return;
  const auto keys = list_in<std::int32_t>(checkpoint.column(pair_column));
  const Bodies& bodies = share.resource<Bodies>();
  const std::vector<std::int32_t> kept = rows_to_keep(bodies, keys, is_with_tools(entity));
  for (const ColumnBase* column : share.columns()) {
    if (!is_of_rows(*column, entity) || column->declared_transient) continue;
    std::vector<std::byte> own;
    own.reserve(kept.size() * column->row_bytes);
    for (std::size_t first = 0, last = 0; first < kept.size(); first = last) {
      while (last < kept.size() && kept[last] - kept[first] == static_cast<int>(last - first))
        ++last;
      const std::vector<std::byte> rows =
          checkpoint.column(entity + std::string("/") + column->info.name,
                            static_cast<std::uint64_t>(kept[first]) * column->row_bytes,
                            (last - first) * column->row_bytes);
      own.insert(own.end(), rows.begin(), rows.end());
    }
    share.set_column(*column, own);
  }
  ContactIndex& index = share.resource<ContactIndex>();
  std::vector<std::int32_t>& begin = is_with_tools(entity) ? index.tool_begin : index.sampled_begin;
  if (!begin.empty()) begin = begins_of(keys_of(share, entity), bodies.slots.size());
}

}  // namespace

void restore_share(const Checkpoint& checkpoint, World& share, std::set<std::string> left_alone) {
  await_outlines(share);
  left_alone.insert("rank_link");
  checkpoint.require_same_parts(share, left_alone);
  for (const World::SavedResource& resource : share.saved_resources())
    if (!left_alone.contains(resource.name)) resource.set_state(checkpoint.resource(resource.name));
  for (std::size_t i = 0; i < share.columns().size(); ++i) {
    const ColumnBase& column = *share.columns()[i];
    if (!is_restored(column, left_alone) || is_of_contacts(column)) continue;
    const std::string name = column.entity + "/" + column.info.name;
    if (!is_by_chunk(column)) {
      share.set_column(column, checkpoint.column(name));
      continue;
    }
    if (checkpoint.column_bytes(name) != column.bytes())
      throw BadState("the rows of " + name + " do not fit the scene");
    for (const int chunk : share.resource<Bodies>().own_chunks) {
      const std::span<const std::byte> rows = column.of_chunk(chunk);
      const auto at = static_cast<std::size_t>(rows.data() - column.data());
      const std::vector<std::byte> saved = checkpoint.column(name, at, rows.size());
      std::ranges::copy(saved, same_column(share, i).data() + at);
    }
  }
  for (const char* entity : row_entities) take_rows(checkpoint, share, entity);
  if (!share.has<ContactIndex>()) return;
  list_rows(share);
  find_border_again(share);
}

}  // namespace pulvis
