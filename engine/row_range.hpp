// Consecutive rows, for iteration: for (const Row<Contact> row : range) ...
#pragma once

#include <cstdint>
#include <vector>

#include "engine/entry.hpp"

namespace pulvis {

template <class Entity>
class RowRange {
 public:
  class Iterator {
   public:
    constexpr explicit Iterator(std::int32_t row) : row_(row) {}
    constexpr Row<Entity> operator*() const { return Row<Entity>(row_); }
    constexpr Iterator& operator++() {
      ++row_;
      return *this;
    }
    bool operator==(const Iterator&) const = default;

   private:
    std::int32_t row_;
  };

  constexpr RowRange(std::int32_t first, std::int32_t end) : first_(first), end_(end) {}
  // The i-th of several ranges with starts `begin`; one extra entry marks the end of the last.
  static RowRange of(const std::vector<std::int32_t>& begin, int i) {
    return {entry(begin, i), entry(begin, i + 1)};
  }
  constexpr Iterator begin() const { return Iterator(first_); }
  constexpr Iterator end() const { return Iterator(end_); }
  constexpr int size() const { return end_ - first_; }

 private:
  std::int32_t first_, end_;
};

}  // namespace pulvis
