// List access by the engine's signed indices and rows: signed, so that differences and "none" (-1) are what
// they look like. Range-checked where assertions are enabled.
#pragma once

#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "engine/component.hpp"

namespace pulvis {

template <class List, std::integral Number>
constexpr decltype(auto) entry(List&& list, Number number) {
  const auto at = static_cast<std::size_t>(number);
  assert(at < std::size(list));
  return std::forward<List>(list)[at];
}
template <class List, class Entity>
constexpr decltype(auto) entry(List&& list, Row<Entity> row) {
  return entry(std::forward<List>(list), row.value);
}

// The entries of one group in a list of consecutive groups: group g runs from begin[g] to begin[g + 1].
template <class T, std::integral Number>
constexpr std::span<const T> entries(const std::vector<T>& list,
                                     const std::vector<std::int32_t>& begin, Number group) {
  const auto first = static_cast<std::size_t>(entry(begin, group));
  const auto last = static_cast<std::size_t>(entry(begin, group + 1));
  assert(first <= last && last <= list.size());
  return std::span(list).subspan(first, last - first);
}

}  // namespace pulvis
