#include "scenes/meshes/boundary_pairs.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "engine/entry.hpp"

namespace pulvis {
namespace {

using Side = std::pair<std::int32_t, std::int32_t>;  // nodes, the smaller number first
Side side_of(std::int32_t a, std::int32_t b) { return std::minmax(a, b); }

// Sides of elements that are not on the boundary.
std::set<Side> inner_sides(const Shape& shape) {
  std::map<Side, int> elements;
  for (const auto& q : shape.quads)
    for (std::size_t k = 0; k < 4; ++k) ++elements[side_of(q[k].value, q[(k + 1) % 4].value)];
  std::set<Side> inner;
  for (const auto& [side, count] : elements)
    if (count > 1) inner.insert(side);
  return inner;
}

std::set<Side> inner_sides(const space::Shape& shape) {
  constexpr std::array<std::array<std::size_t, 2>, 12> sides{{{0, 1},
                                                              {1, 2},
                                                              {2, 3},
                                                              {3, 0},
                                                              {4, 5},
                                                              {5, 6},
                                                              {6, 7},
                                                              {7, 4},
                                                              {0, 4},
                                                              {1, 5},
                                                              {2, 6},
                                                              {3, 7}}};
  std::set<Side> inner;
  for (const auto& h : shape.hexahedra)
    for (const auto& [a, b] : sides) inner.insert(side_of(h[a].value, h[b].value));
  for (const space::Shape::Face& face : shape.faces)
    for (std::size_t k = 0; k < 4; ++k)
      inner.erase(side_of(face.corner[k].value, face.corner[(k + 1) % 4].value));
  return inner;
}

template <class AnyShape>
double distance2(const AnyShape& shape, std::int32_t a, std::int32_t b) {
  double sum = 0;
  for (std::size_t k = 0; k < entry(shape.nodes, a).size(); ++k) {
    const double d = entry(shape.nodes, a)[k] - entry(shape.nodes, b)[k];
    sum += d * d;
  }
  return sum;
}

template <class AnyShape>
BoundaryPairs pairs_of(const AnyShape& shape) {
  std::vector<std::vector<std::int32_t>> inwards(static_cast<std::size_t>(shape.boundary_nodes));
  for (const auto& [a, b] : inner_sides(shape)) {
    if (a < shape.boundary_nodes) entry(inwards, a).push_back(b);
    if (b < shape.boundary_nodes) entry(inwards, b).push_back(a);
  }
  BoundaryPairs pairs;
  std::vector<bool> taken(shape.nodes.size(), false);
  const auto is_taken = [&](std::int32_t n) { return taken[static_cast<std::size_t>(n)]; };
  for (std::int32_t outer = 0; outer < shape.boundary_nodes; ++outer) {
    if (is_taken(outer)) continue;
    std::int32_t nearest = -1;
    for (const std::int32_t n : entry(inwards, outer))
      if (!is_taken(n) &&
          (nearest < 0 || distance2(shape, outer, n) < distance2(shape, outer, nearest)))
        nearest = n;
    if (nearest < 0) continue;
    pairs.all.push_back({Row<Node>(outer), Row<Node>(nearest)});
    taken[static_cast<std::size_t>(outer)] = taken[static_cast<std::size_t>(nearest)] = true;
  }
  for (std::int32_t n = 0; n < static_cast<std::int32_t>(shape.nodes.size()); ++n)
    if (!is_taken(n)) pairs.single.push_back(Row<Node>(n));
  return pairs;
}

}  // namespace

BoundaryPairs boundary_pairs(const Shape& shape) { return pairs_of(shape); }
BoundaryPairs boundary_pairs(const space::Shape& shape) { return pairs_of(shape); }

}  // namespace pulvis
