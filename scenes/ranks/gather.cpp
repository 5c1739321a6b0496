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

// Found by the step, or by the root where results are taken, and not what all ranks have alike.
bool is_of_a_share(const std::string& resource) {
  static const std::set<std::string> own{
      "bodies",        "rank_link",          "contact_index",      "contact_quality",
      "contact_network", "density_grid",     "force_chains",       "fragments",
      "contact_sums",  "tool_contact_sums",  "contact_blocks",     "tool_contact_blocks",
      "face_pairs",    "face_tool_contact_blocks", "other_loads",  "triangle_lists"};
  return own.contains(resource);
}

}  // namespace

Gatherer::Gatherer(World& share, World* whole)
    : share_(share), whole_(whole), ranks_(*share.resource<RankLink>().ranks) {}

// What each chunk has, of all ranks, in the order of the chunks; on the root.
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
  std::vector<std::byte> bytes;
  for (const int chunk : share_.resource<Bodies>().own_chunks) {
    const std::span<const std::byte> rows = own.of_chunk(chunk);
    bytes.insert(bytes.end(), rows.begin(), rows.end());
  }
  const std::vector<Ranks::Bytes> all = ranks_.gather(bytes);
  if (whole_ == nullptr) return;
  ColumnBase& column = same_column(*whole_, number);
  const std::vector<int>& owner = share_.resource<RankLink>().owner;
  std::vector<std::size_t> at(all.size());
  for (std::size_t chunk = 0; chunk < owner.size(); ++chunk) {
    const auto rank = static_cast<std::size_t>(owner[chunk]);
    const std::span<const std::byte> rows = column.of_chunk(static_cast<int>(chunk));
    if (rows.empty()) continue;
    std::memcpy(column.data() + (rows.data() - column.data()), all[rank].data() + at[rank],
                rows.size());
    at[rank] += rows.size();
  }
}

// How many rows every slot has: here, and on the root of all.
void Gatherer::slot_rows(const char* entity, std::vector<std::int32_t>& own_begin,
                          std::vector<std::int32_t>& whole_begin) {
  const ContactIndex& index = share_.resource<ContactIndex>();
  const Bodies& bodies = share_.resource<Bodies>();
  own_begin = is_with_tools(entity) ? index.tool_begin : index.sampled_begin;
  if (own_begin.empty()) own_begin.assign(bodies.slots.size() + 1, 0);
  std::vector<std::int32_t> counts;
  bodies.for_own_lanes(
      [&](int slot) { counts.push_back(entry(own_begin, slot + 1) - entry(own_begin, slot)); });
  const std::vector<std::byte> all =
      joined(bytes_of(counts),
             std::vector<std::size_t>(static_cast<std::size_t>(bodies.chunks()),
                                      lane_count * sizeof(std::int32_t)));
  if (whole_ == nullptr) return;
  const auto of_slot = list_in<std::int32_t>(all);
  whole_begin.assign(1, 0);
  for (const std::int32_t count : of_slot) whole_begin.push_back(whole_begin.back() + count);
}

void Gatherer::rows() {
  if (!share_.has<ContactIndex>()) return;
  const Bodies& bodies = share_.resource<Bodies>();
  std::vector<std::int32_t> sampled_begin, tool_begin;
  for (const char* entity : row_entities) {
    const auto is_one = [&](const ColumnBase* column) { return is_of_rows(*column, entity); };
    if (std::ranges::none_of(share_.columns(), is_one)) continue;
    std::vector<std::int32_t> own, whole;
    slot_rows(entity, own, whole);
    std::vector<std::size_t> rows_of_chunk;
    for (std::size_t slot = lane_count; slot < whole.size(); slot += lane_count)
      rows_of_chunk.push_back(static_cast<std::size_t>(whole[slot] - whole[slot - lane_count]));
    for (std::size_t number = 0; number < share_.columns().size(); ++number) {
      const ColumnBase& column = *share_.columns()[number];
      if (!is_one(&column)) continue;
      std::vector<std::byte> bytes;
      for (const int chunk : bodies.own_chunks) {
        const auto rows = rows_of(column, static_cast<std::size_t>(entry(own, chunk * lane_count)),
                                  static_cast<std::size_t>(entry(own, (chunk + 1) * lane_count)));
        bytes.insert(bytes.end(), rows.begin(), rows.end());
      }
      std::vector<std::size_t> bytes_of_chunk;
      for (const std::size_t rows : rows_of_chunk)
        bytes_of_chunk.push_back(rows * column.row_bytes);
      const std::vector<std::byte> all = joined(bytes, bytes_of_chunk);
      if (whole_ != nullptr) whole_->set_column(*whole_->columns()[number], all);
    }
    if (std::string(entity) == FaceToolContact::name) triangles(own, whole);
    if (whole_ != nullptr) (is_with_tools(entity) ? tool_begin : sampled_begin) = whole;
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

// What the rows of all ranks can touch of tools that are meshes: every rank has a list of its own rows.
void Gatherer::triangles(const std::vector<std::int32_t>& own_begin,
                         const std::vector<std::int32_t>& whole_begin) {
  if (!share_.has<space::TriangleLists>()) return;
  const auto& lists = share_.resource<space::TriangleLists>();
  const std::int32_t* own = share_.column<space::TriangleRange>().values();
  std::vector<std::int32_t> listed;
  for (const int chunk : share_.resource<Bodies>().own_chunks)
    for (int r = entry(own_begin, chunk * lane_count); r < entry(own_begin, (chunk + 1) * lane_count);
         ++r)
      lists.append(own + 2 * r, listed);
  std::vector<std::size_t> bytes_of_chunk;
  std::int32_t* whole =
      whole_ != nullptr ? whole_->column<space::TriangleRange>().values() : nullptr;
  for (std::size_t slot = lane_count; slot < whole_begin.size(); slot += lane_count) {
    std::size_t triangles = 0;
    for (int r = whole_begin[slot - lane_count]; r < whole_begin[slot]; ++r)
      triangles += static_cast<std::size_t>(whole[2 * r + 1] - whole[2 * r]);
    bytes_of_chunk.push_back(triangles * sizeof(std::int32_t));
  }
  const auto all = list_in<std::int32_t>(joined(bytes_of(listed), bytes_of_chunk));
  if (whole_ == nullptr) return;
  whole_->resource<space::TriangleLists>().triangles = all;
  space::TriangleLists::stand_together(
      {whole, 2 * static_cast<std::size_t>(whole_begin.back())});
}

// Of all particles, as the broad phase found them.
void Gatherer::neighbours() {
  const ContactIndex& own = share_.resource<ContactIndex>();
  const Bodies& bodies = share_.resource<Bodies>();
  std::vector<std::int32_t> counts, slots;
  std::vector<std::array<std::int32_t, 2>> images;
  if (!own.neighbour_begin.empty())
    bodies.for_own_lanes([&](int slot) {
      const auto first = static_cast<std::size_t>(entry(own.neighbour_begin, slot)),
                 last = static_cast<std::size_t>(entry(own.neighbour_begin, slot + 1));
      counts.push_back(static_cast<std::int32_t>(last - first));
      for (std::size_t k = first; k < last; ++k) {
        slots.push_back(own.neighbours[k]);
        if (!own.images.empty()) images.push_back(own.images[k]);
      }
    });
  else
    bodies.for_own_lanes([&](int) { counts.push_back(0); });
  const auto chunks = static_cast<std::size_t>(bodies.chunks());
  const std::vector<std::byte> all =
      joined(bytes_of(counts),
             std::vector<std::size_t>(chunks, lane_count * sizeof(std::int32_t)));
  const auto of_slot = list_in<std::int32_t>(all);
  std::vector<std::size_t> of_chunk(chunks), images_of_chunk(chunks);
  for (std::size_t slot = 0; slot < of_slot.size(); ++slot) {
    const auto count = static_cast<std::size_t>(of_slot[slot]);
    of_chunk[slot / lane_count] += count * sizeof(std::int32_t);
    if (share_.has<PeriodicCell>())
      images_of_chunk[slot / lane_count] += count * 2 * sizeof(std::int32_t);
  }
  const auto whole_slots = list_in<std::int32_t>(joined(bytes_of(slots), of_chunk));
  const auto whole_images =
      list_in<std::array<std::int32_t, 2>>(joined(bytes_of(images), images_of_chunk));
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
    const auto own = std::ranges::find(share_.saved_resources(), resource.name,
                                       &World::SavedResource::name);
    resource.set_state(own->state());
  }
}

// ---- a checkpoint dealt out -----------------------------------------------------------------------
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
    const std::vector<std::byte> all = checkpoint.column(entity + std::string("/") +
                                                         column->info.name);
    std::vector<std::byte> own;
    own.reserve(kept.size() * column->row_bytes);
    for (const std::int32_t r : kept) {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(r) *
                                           static_cast<std::ptrdiff_t>(column->row_bytes);
      own.insert(own.end(), first, first + static_cast<std::ptrdiff_t>(column->row_bytes));
    }
    share.set_column(*column, own);
  }
  ContactIndex& index = share.resource<ContactIndex>();
  std::vector<std::int32_t>& begin =
      is_with_tools(entity) ? index.tool_begin : index.sampled_begin;
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
    if (column.declared_transient) continue;
    const bool of_rows = std::ranges::any_of(
        row_entities, [&](const char* entity) { return is_of_rows(column, entity); });
    if (of_rows) continue;
    const std::vector<std::byte> all =
        checkpoint.column(column.entity + "/" + column.info.name);
    if (!is_by_chunk(column)) {
      share.set_column(column, all);
      continue;
    }
    if (all.size() != column.bytes())
      throw BadState("the rows of " + column.entity + "/" + column.info.name +
                     " do not fit the scene");
    for (const int chunk : share.resource<Bodies>().own_chunks) {
      const std::span<const std::byte> rows = column.of_chunk(chunk);
      const auto at = rows.data() - column.data();
      std::memcpy(same_column(share, i).data() + at, all.data() + at, rows.size());
    }
  }
  for (const char* entity : row_entities) take_rows(checkpoint, share, entity);
  if (!share.has<ContactIndex>()) return;
  list_rows(share);
  find_border_again(share);
}

}  // namespace pulvis
