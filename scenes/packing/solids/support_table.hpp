// The farthest of many points along a direction. Directions are looked up in the cells of a cube around them; each cell
// holds the few points that are extreme along one of its directions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenes/packing/solids/vector.hpp"

namespace pulvis::space {

class SupportTable {
 public:
  SupportTable() = default;
  explicit SupportTable(std::vector<V3> points);
  const V3& extreme(const V3& direction) const;  // of any length except 0
  const std::vector<V3>& points() const { return points_; }
  bool operator==(const SupportTable& other) const { return points_ == other.points_; }
  std::size_t bytes() const {
    return (points_.size() + candidates_.size()) * sizeof(V3) + begin_.size() * sizeof(begin_[0]);
  }

 private:
  std::vector<V3> points_;
  std::vector<V3> candidates_;
  std::vector<std::int32_t> begin_;  // [cells + 1] into the candidates
};

}  // namespace pulvis::space
