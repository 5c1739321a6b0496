#include "scenes/grains/grain_map.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

namespace pulvis {
namespace {

using Side = GrainMap::Side;
using Grain = std::vector<Side>;

constexpr int outside = GrainMap::outside;

const GrainMap::Vertex& vertex_of(const GrainMap& map, int number) {
  return map.vertices[static_cast<std::size_t>(number)];
}

int end_of(const Grain& grain, std::size_t side) { return grain[(side + 1) % grain.size()].vertex; }

// The grains on either side of a vanished grain become neighbours.
void take_out_of(Grain& grain, std::size_t number, GrainMap& map) {
  for (std::size_t i = 0; i < grain.size(); ++i) {
    const int behind = grain[i].neighbour;
    if (behind == outside) continue;
    const int other = grain[(i + 1) % grain.size()].neighbour;
    for (Side& side : map.grains[static_cast<std::size_t>(behind)])
      if (side.neighbour == static_cast<int>(number)) side.neighbour = other;
  }
  grain.clear();
}

class Joining {
 public:
  Joining(GrainMap& map, const OutlineCurve& outline) : map_(map), outline_(outline) {}

  // Collapses the shortest side below `least` that can be removed.
  bool join_shortest(double least) {
    double shortest = least;
    std::optional<std::pair<int, int>> ends;
    for (const Grain& grain : map_.grains)
      for (std::size_t i = 0; i < grain.size(); ++i) {
        const int a = grain[i].vertex, b = end_of(grain, i);
        const double length = side_length(map_, grain, i, outline_.length());
        if (length >= shortest || !can_join(a, b, grain[i].neighbour)) continue;
        shortest = length;
        ends = {a, b};
      }
    if (!ends) return false;
    join(ends->first, ends->second);
    return true;
  }

 private:
  // Not two corners of the outline, nor two points of it across a grain.
  bool can_join(int a, int b, int neighbour) const {
    const auto &p = vertex_of(map_, a), &q = vertex_of(map_, b);
    if (p.corner && q.corner) return false;
    return !(p.on_outline() && q.on_outline()) || neighbour == outside;
  }

  void join(int a, int b) {
    auto& kept = map_.vertices[static_cast<std::size_t>(a)];
    const auto& other = map_.vertices[static_cast<std::size_t>(b)];
    if (!kept.on_outline() && !other.on_outline()) {
      kept.at = (kept.at + other.at) / 2;
    } else if (kept.on_outline() && other.on_outline() && !kept.corner && !other.corner) {
      const double length = outline_.length();
      const double way = std::remainder(other.s - kept.s, length);
      kept.s = std::fmod(kept.s + way / 2 + length, length);
      kept.at = outline_.at(kept.s).at;
    } else if (other.corner || !kept.on_outline()) {
      kept = other;
    }
    for (Grain& grain : map_.grains) {
      for (Side& side : grain)
        if (side.vertex == b) side.vertex = a;
      for (std::size_t i = 0; i < grain.size();)
        if (grain.size() > 1 && grain[i].vertex == end_of(grain, i))
          grain.erase(grain.begin() + static_cast<std::ptrdiff_t>(i));
        else
          ++i;
    }
    for (std::size_t g = 0; g < map_.grains.size(); ++g)
      if (map_.grains[g].size() == 1 || map_.grains[g].size() == 2)
        take_out_of(map_.grains[g], g, map_);
  }

  GrainMap& map_;
  const OutlineCurve& outline_;
};

void number_anew(GrainMap& map) {
  std::vector<int> number(map.grains.size(), outside);
  std::vector<Grain> left;
  for (std::size_t g = 0; g < map.grains.size(); ++g) {
    if (map.grains[g].empty()) continue;
    number[g] = static_cast<int>(left.size());
    left.push_back(std::move(map.grains[g]));
  }
  for (Grain& grain : left)
    for (Side& side : grain)
      if (side.neighbour != outside)
        side.neighbour = number[static_cast<std::size_t>(side.neighbour)];
  map.grains = std::move(left);
}

class Division {
 public:
  Division(GrainMap& map, double size, double outline) : map_(map) {
    for (Grain& grain : map.grains)
      for (std::size_t i = 0; i < grain.size(); ++i)
        grain[i].edges =
            std::max(1, static_cast<int>(std::lround(side_length(map, grain, i, outline) / size)));
    for (std::size_t g = 0; g < map.grains.size(); ++g)
      while (edges_of(g) < fewest) add(g, longest(g, outline), 1);
  }

  // Adds one edge on the path from every odd grain to the outline: a tree of neighbours, leaves first.
  void make_even() {
    const std::size_t none = map_.grains.size();
    std::vector<std::size_t> way_out(map_.grains.size(), none), order;
    std::vector<bool> reached(map_.grains.size(), false);
    const auto reach = [&](std::size_t grain, std::size_t side) {
      reached[grain] = true;
      way_out[grain] = side;
      order.push_back(grain);
    };
    for (std::size_t g = 0; g < map_.grains.size(); ++g)
      for (std::size_t i = 0; i < map_.grains[g].size() && !reached[g]; ++i)
        if (map_.grains[g][i].neighbour == outside) reach(g, i);
    for (std::size_t at = 0; at < order.size(); ++at)
      for (const Side& side : map_.grains[order[at]]) {
        if (side.neighbour == outside) continue;
        const auto next = static_cast<std::size_t>(side.neighbour);
        if (!reached[next]) reach(next, side_towards(next, order[at]));
      }
    for (std::size_t at = order.size(); at-- > 0;)
      if (edges_of(order[at]) % 2 != 0) add(order[at], way_out[order[at]], 1);
  }

 private:
  static constexpr int fewest = 8;

  int edges_of(std::size_t grain) const {
    int edges = 0;
    for (const Side& side : map_.grains[grain]) edges += side.edges;
    return edges;
  }

  std::size_t longest(std::size_t g, double outline) const {
    const Grain& grain = map_.grains[g];
    std::size_t best = 0;
    double length = 0;
    for (std::size_t i = 0; i < grain.size(); ++i) {
      const double edge = side_length(map_, grain, i, outline) / grain[i].edges;
      if (edge <= length) continue;
      length = edge;
      best = i;
    }
    return best;
  }

  std::size_t side_towards(std::size_t grain, std::size_t neighbour) const {
    const Grain& sides = map_.grains[grain];
    for (std::size_t i = 0; i < sides.size(); ++i)
      if (sides[i].neighbour == static_cast<int>(neighbour)) return i;
    return 0;
  }

  // On both sides of the face.
  void add(std::size_t g, std::size_t i, int more) {
    Side& side = map_.grains[g][i];
    side.edges += more;
    if (side.neighbour == outside) return;
    const int from = side.vertex, to = end_of(map_.grains[g], i);
    Grain& behind = map_.grains[static_cast<std::size_t>(side.neighbour)];
    for (std::size_t k = 0; k < behind.size(); ++k)
      if (behind[k].vertex == to && end_of(behind, k) == from) behind[k].edges = side.edges;
  }

  GrainMap& map_;
};

}  // namespace

double side_length(const GrainMap& map, const Grain& grain, std::size_t side, double outline) {
  const auto &from = vertex_of(map, grain[side].vertex), &to = vertex_of(map, end_of(grain, side));
  if (grain[side].neighbour != outside) return (to.at - from.at).norm();
  return to.s > from.s ? to.s - from.s : to.s + outline - from.s;
}

void join_short_sides(GrainMap& map, double least, const OutlineCurve& outline) {
  Joining joining(map, outline);
  while (joining.join_shortest(least)) {
  }
  number_anew(map);
}

void divide_sides(GrainMap& map, double size, double outline) {
  Division division(map, size, outline);
  division.make_even();
}

}  // namespace pulvis
