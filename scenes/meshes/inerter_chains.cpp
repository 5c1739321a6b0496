#include "scenes/meshes/inerter_chains.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
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

// Quadrilaterals in the body: the elements, or the faces between two of them.
std::vector<std::array<std::int32_t, 4>> inner_quads(const Shape& shape) {
  std::vector<std::array<std::int32_t, 4>> quads;
  for (const auto& q : shape.quads)
    quads.push_back({q[0].value, q[1].value, q[2].value, q[3].value});
  return quads;
}
std::vector<std::array<std::int32_t, 4>> inner_quads(const space::Shape& shape) {
  constexpr std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  std::set<std::array<std::int32_t, 4>> seen;
  std::vector<std::array<std::int32_t, 4>> quads;
  for (const auto& h : shape.hexahedra)
    for (const auto& face : faces) {
      std::array<std::int32_t, 4> quad, sorted;
      for (std::size_t k = 0; k < 4; ++k) quad[k] = h[face[k]].value;
      sorted = quad;
      std::ranges::sort(sorted);
      if (!seen.insert(sorted).second) quads.push_back(quad);
    }
  return quads;
}

using Neighbours = std::vector<std::vector<std::int32_t>>;  // [nodes]

template <class AnyShape>
Neighbours neighbours_of(const AnyShape& shape) {
  Neighbours neighbours(shape.nodes.size());
  for (const auto& [a, b] : inner_sides(shape)) {
    entry(neighbours, a).push_back(b);
    entry(neighbours, b).push_back(a);
  }
  return neighbours;
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

// Cosine of the angle between the sides from a to b and from b to c.
template <class AnyShape>
double alignment(const AnyShape& shape, std::int32_t a, std::int32_t b, std::int32_t c) {
  double sum = 0;
  for (std::size_t k = 0; k < entry(shape.nodes, a).size(); ++k)
    sum += (entry(shape.nodes, b)[k] - entry(shape.nodes, a)[k]) *
           (entry(shape.nodes, c)[k] - entry(shape.nodes, b)[k]);
  return sum / std::sqrt(distance2(shape, a, b) * distance2(shape, b, c));
}

const auto& elements_of(const Shape& shape) { return shape.quads; }
const auto& elements_of(const space::Shape& shape) { return shape.hexahedra; }

struct Extension {
  double alignment;
  int chain;
  std::int32_t third;
};
// Nodes that may become the third of a chain, the best first: behind the corners of a core that is the node across an element.
template <class AnyShape>
std::vector<Extension> extensions(const AnyShape& shape, const InerterChains& chains) {
  constexpr double straight = 0.7;  // cosine
  std::vector<int> chain_of_inner(shape.nodes.size(), -1);
  for (int i = 0; i < static_cast<int>(chains.all.size()); ++i)
    if (entry(chains.all, i).links == 1)
      entry(chain_of_inner, entry(chains.all, i).nodes[1].value) = i;
  std::vector<Extension> found;
  for (const auto& element : elements_of(shape))
    for (const Row<Node> inner : element) {
      const int chain = entry(chain_of_inner, inner.value);
      if (chain < 0) continue;
      const std::int32_t outer = entry(chains.all, chain).nodes[0].value;
      for (const Row<Node> third : element) {
        if (third.value == inner.value || third.value == outer) continue;
        const double aligned = alignment(shape, outer, inner.value, third.value);
        if (aligned > straight) found.push_back({aligned, chain, third.value});
      }
    }
  std::ranges::sort(found, [](const Extension& a, const Extension& b) {
    return std::tie(b.alignment, a.chain, a.third) < std::tie(a.alignment, b.chain, b.third);
  });
  return found;
}

template <class AnyShape>
InerterChains chains_of(const AnyShape& shape) {
  const Neighbours neighbours = neighbours_of(shape);
  InerterChains chains;
  std::vector<bool> taken(shape.nodes.size(), false);
  const auto take = [&](std::int32_t n) { taken[static_cast<std::size_t>(n)] = true; };
  // No side leads inwards from a corner, or from the edge of a body: it moves with the two nodes beside it and the one across.
  constexpr double sharp = 0.5;  // cosine of the angle there: none at the tip of a star
  for (std::array<std::int32_t, 4> quad : inner_quads(shape)) {
    const auto corner = std::ranges::find_if(quad, [&](std::int32_t n) {
      return n < shape.boundary_nodes && entry(neighbours, n).empty();
    });
    if (corner == quad.end() || std::ranges::any_of(quad, [&](std::int32_t n) {
          return taken[static_cast<std::size_t>(n)];
        }))
      continue;
    std::rotate(quad.begin(), corner, quad.end());
    if (std::abs(alignment(shape, quad[1], quad[0], quad[3])) > sharp) continue;
    InerterChains::Chain& ring = chains.all.emplace_back();
    ring.links = links_of_ring;
    for (std::size_t k = 0; k < quad.size(); ++k) ring.nodes[k] = Row<Node>(quad[k]), take(quad[k]);
  }
  for (std::int32_t outer = 0; outer < shape.boundary_nodes; ++outer) {
    if (taken[static_cast<std::size_t>(outer)]) continue;
    std::int32_t nearest = -1;
    for (const std::int32_t n : entry(neighbours, outer))
      if (!taken[static_cast<std::size_t>(n)] &&
          (nearest < 0 || distance2(shape, outer, n) < distance2(shape, outer, nearest)))
        nearest = n;
    if (nearest < 0) continue;
    chains.all.push_back({{Row<Node>(outer), Row<Node>(nearest), Row<Node>(-1), Row<Node>(-1)}});
    take(outer), take(nearest);
  }
  for (const Extension& e : extensions(shape, chains)) {
    InerterChains::Chain& chain = entry(chains.all, e.chain);
    if (chain.links != 1 || taken[static_cast<std::size_t>(e.third)]) continue;
    chain.nodes[2] = Row<Node>(e.third);
    chain.links = 2;
    take(e.third);
  }
  for (InerterChains::Chain& chain : chains.all) {
    const auto size = [&](int i) { return shape.size_of_node(entry(chain.nodes, i).value); };
    for (int i = 0; i < nodes_of_chain(chain.links); ++i) entry(chain.inv_size, i) = 1 / size(i);
    for (int i = 0; i < chain.links; ++i)
      entry(chain.reduced, i) =
          1 / (entry(chain.inv_size, i) + entry(chain.inv_size, next_in_chain(i, chain.links)));
  }
  for (std::int32_t n = 0; n < static_cast<std::int32_t>(shape.nodes.size()); ++n)
    if (!taken[static_cast<std::size_t>(n)]) chains.single.push_back(Row<Node>(n));
  return chains;
}

}  // namespace

InerterChains inerter_chains(const Shape& shape) { return chains_of(shape); }
InerterChains inerter_chains(const space::Shape& shape) { return chains_of(shape); }

}  // namespace pulvis
