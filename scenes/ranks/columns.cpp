#include "scenes/ranks/columns.hpp"

#include <algorithm>
#include <numeric>

#include "components/run_state.hpp"
#include "components/shape.hpp"
#include "engine/entry.hpp"

namespace pulvis {

std::vector<std::int32_t> row_begins_in(const World& world, const std::string& entity) {
  const ContactIndex& index = world.resource<ContactIndex>();
  std::vector<std::int32_t> begin = is_with_tools(entity) ? index.tool_begin : index.sampled_begin;
  if (begin.empty()) begin.assign(world.resource<Bodies>().slots.size() + 1, 0);
  return begin;
}

std::span<const std::byte> rows_of_chunk(const ColumnBase& column, int chunk,
                                         const std::vector<std::int32_t>& begin) {
  if (is_by_chunk(column)) return column.of_chunk(chunk);
  return rows_of(column, static_cast<std::size_t>(entry(begin, chunk * lane_count)),
                 static_cast<std::size_t>(entry(begin, (chunk + 1) * lane_count)));
}

std::span<const std::int32_t> keys_of(const World& world, const char* entity) {
  const std::string name = ContactPair<Contact>::info.name;
  const auto pair = std::ranges::find_if(world.columns(), [&](const ColumnBase* column) {
    return is_of_rows(*column, entity) && column->info.name == name;
  });
  if (pair == world.columns().end()) return {};
  return {reinterpret_cast<const std::int32_t*>((*pair)->data()), 3 * (*pair)->owner().rows};
}

std::vector<std::int32_t> begins_of(std::span<const std::int32_t> keys, std::size_t slots) {
  std::vector<std::int32_t> begin(slots + 1);
  for (std::size_t k = 0; k < keys.size(); k += 3) entry(begin, keys[k] + 1) += 1;
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  return begin;
}

}  // namespace pulvis
