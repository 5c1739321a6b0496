// An entry of a list by a number or row as the engine counts them: signed, so that differences and "none" (-1) are what
// they look like. Checked where assertions are on.
#pragma once

#include <cassert>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <utility>

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

}  // namespace pulvis
