#include "systems/ranks/restore.hpp"

#include <algorithm>
#include <cstring>
#include <map>

#include "systems/ranks/border.hpp"
#include "systems/ranks/systems.hpp"

namespace pulvis {
namespace {

template <class At>
std::span<const std::int32_t> keys_of(const World& world) {
  const Column<ContactPair<At>>& pair = world.column<ContactPair<At>>();
  return {pair.values(), 3 * pair.table.rows};
}

// None without a periodic cell.
std::span<const std::int32_t> images_of(const World& world) {
  using Images = ContactImage<FaceContact>;
  if (!world.has<Images>()) return {};
  const Column<Images>& column = world.column<Images>();
  return {column.values(), 3 * column.table.rows};
}

// Particles of other ranks, by rank, that were near those of this one when the rows were built.
std::map<int, std::vector<int>> needed_of(const World& share) {
  const ContactIndex& index = share.resource<ContactIndex>();
  const Bodies& bodies = share.resource<Bodies>();
  const RankLink& link = share.resource<RankLink>();
  std::map<int, std::vector<int>> needed;
  if (index.neighbour_begin.empty()) return needed;
  for (const int slot : bodies.own_slots)
    for (int k = entry(index.neighbour_begin, slot); k < entry(index.neighbour_begin, slot + 1);
         ++k) {
      const int other = entry(index.neighbours, k);
      if (!bodies.owns(other)) needed[link.owner_of(other)].push_back(other);
    }
  for (auto& [rank, slots] : needed) {
    std::ranges::sort(slots);
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  }
  return needed;
}

template <class System>
System opened(World& world) {
  return detail::Opener{world}.open<System>();
}

template <class D>
void tell_all(World& share) {
  std::vector<Outlines> columns = opened<OutlineColumns<D>>(share).all();
  columns.emplace_back(Write<typename D::OutlineBefore>(share));
  tell_border(share.resource<RankLink>(), columns);
}

}  // namespace

void list_rows(World& world) {
  ContactIndex& index = world.resource<ContactIndex>();
  if (world.has<RowBlocks<Contact>>() && !index.sampled_begin.empty()) {
    world.resource<RowBlocks<Contact>>().divide(index.sampled_begin);
    index.list_others(keys_of<Contact>(world));
  }
  if (world.has<RowBlocks<ToolContact>>() && !index.tool_begin.empty())
    world.resource<RowBlocks<ToolContact>>().divide(index.tool_begin);
  if (world.has<RowBlocks<FaceToolContact>>() && !index.tool_begin.empty())
    world.resource<RowBlocks<FaceToolContact>>().divide(index.tool_begin);
  if (world.has<space::FacePairs>() && !index.sampled_begin.empty())
    world.resource<space::FacePairs>().list(keys_of<FaceContact>(world), images_of(world),
                                            index.sampled_begin.size());
}

void await_outlines(World& share) {
  if (share.has<ContactPair<Contact>>()) opened<receive_outlines<TwoD>>(share)(SmallTasks{});
  if (share.has<ContactPair<FaceContact>>()) opened<receive_outlines<ThreeD>>(share)(SmallTasks{});
}

void find_border_again(World& share) {
  const bool plane = share.has<ContactPair<Contact>>();
  if (!plane && !share.has<ContactPair<FaceContact>>()) return;
  RankLink& link = share.resource<RankLink>();
  Bodies& bodies = share.resource<Bodies>();
  const auto count = static_cast<std::size_t>(link.ranks->count());
  std::vector<std::vector<int>> receive(count);
  for (auto& [rank, slots] : needed_of(share))
    receive[static_cast<std::size_t>(rank)] = std::move(slots);
  std::vector<Ranks::Bytes> asked(count);
  for (std::size_t r = 0; r < count; ++r) asked[r] = bytes_of_slots(receive[r]);
  const std::vector<Ranks::Bytes> wanted = link.ranks->all_to_all(std::move(asked));
  std::vector<int> border;
  link.border.clear();
  for (std::size_t r = 0; r < count; ++r) {
    if (receive[r].empty() && wanted[r].empty()) continue;
    border.insert(border.end(), receive[r].begin(), receive[r].end());
    link.border.push_back({static_cast<int>(r), slots_in(wanted[r]), receive[r]});
  }
  bodies.set_border(border);
  if (plane) {
    tell_all<TwoD>(share);
    opened<list_border_rows>(share).list();
  } else {
    tell_all<ThreeD>(share);
    opened<list_border_pairs>(share).list();
  }
}

}  // namespace pulvis
