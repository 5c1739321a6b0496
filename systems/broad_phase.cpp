#include "systems/broad_phase.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pulvis {

Box box_of(const double* points, int count) {
  Box box{{points[0], points[1]}, {points[0], points[1]}};
  for (int i = 1; i < count; ++i)
    for (int k = 0; k < 2; ++k) {
      box.low[k] = std::min(box.low[k], points[2 * i + k]);
      box.high[k] = std::max(box.high[k], points[2 * i + k]);
    }
  return box;
}

bool near(const Box& a, const Box& b, double skin) {
  for (int k = 0; k < 2; ++k)
    if (a.low[k] > b.high[k] + skin || b.low[k] > a.high[k] + skin) return false;
  return true;
}

namespace {

// Particles by cell of a uniform grid; a cell is as large as the largest particle, so that neighbours
// stand in the cells around.
class Grid {
 public:
  Grid(const std::vector<Box>& boxes, const std::vector<int>& slots, double skin) {
    Box all = boxes[static_cast<std::size_t>(slots.front())];
    for (const int s : slots) {
      const Box& b = boxes[static_cast<std::size_t>(s)];
      for (int k = 0; k < 2; ++k) {
        all.low[k] = std::min(all.low[k], b.low[k]);
        all.high[k] = std::max(all.high[k], b.high[k]);
        size_ = std::max(size_, b.high[k] - b.low[k] + skin);
      }
    }
    for (int k = 0; k < 2; ++k) {
      low_[k] = all.low[k];
      // A particle that flew off must not ask for a grid of its own; far cells fold into the last one.
      count_[k] = static_cast<int>(std::clamp((all.high[k] - all.low[k]) / size_ + 1, 1.0, 4096.0));
    }
    cell_begin_.assign(static_cast<std::size_t>(count_[0] * count_[1]) + 1, 0);
    for (const int s : slots) cell_begin_[cell(boxes[static_cast<std::size_t>(s)]) + 1] += 1;
    std::partial_sum(cell_begin_.begin(), cell_begin_.end(), cell_begin_.begin());
    members_.resize(slots.size());
    std::vector<std::int32_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
    for (const int s : slots)
      members_[static_cast<std::size_t>(next[cell(boxes[static_cast<std::size_t>(s)])]++)] = s;
  }

  template <class Visit>
  void around(const Box& box, const Visit& visit) const {
    const int cx = index(box, 0), cy = index(box, 1);
    for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, count_[1] - 1); ++y)
      for (int x = std::max(cx - 1, 0); x <= std::min(cx + 1, count_[0] - 1); ++x) {
        const auto c = static_cast<std::size_t>(y * count_[0] + x);
        for (int m = cell_begin_[c]; m < cell_begin_[c + 1]; ++m)
          visit(members_[static_cast<std::size_t>(m)]);
      }
  }

 private:
  int index(const Box& box, int k) const {
    const double middle = 0.5 * (box.low[k] + box.high[k]);
    return static_cast<int>(std::clamp((middle - low_[k]) / size_, 0.0, count_[k] - 1.0));
  }
  std::size_t cell(const Box& box) const {
    return static_cast<std::size_t>(index(box, 1) * count_[0] + index(box, 0));
  }

  double size_ = 0;
  double low_[2] = {0, 0};
  int count_[2] = {1, 1};
  std::vector<std::int32_t> cell_begin_, members_;
};

struct Curves {
  const Bodies& bodies;
  std::span<const double> control;
  std::vector<Box> particle;  // [slots]

  const double* points(int slot) const {
    return control.data() + 2 * bodies.slots[static_cast<std::size_t>(slot)].first_control;
  }
  const double* edge_points(int slot, int e) const {
    const Shape& shape = bodies.shape_of_slot(slot);
    return points(slot) + 2 * shape.edges[static_cast<std::size_t>(e)].first_control;
  }
  Box edge(int slot, int e) const { return box_of(edge_points(slot, e), 4); }
};

using Spot = std::array<double, 2>;

// Where the edge with these four control points begins.
Spot knot(const double* y) { return {(y[0] + 4 * y[2] + y[4]) / 6, (y[1] + 4 * y[3] + y[5]) / 6}; }

double squared_distance_to_chord(const Spot& p, const double* control) {
  const Spot a = knot(control), b = knot(control + 2);
  const double cx = b[0] - a[0], cy = b[1] - a[1], rx = p[0] - a[0], ry = p[1] - a[1];
  const double share = std::clamp((rx * cx + ry * cy) / (cx * cx + cy * cy), 0.0, 1.0);
  const double dx = rx - share * cx, dy = ry - share * cy;
  return dx * dx + dy * dy;
}

// The sampled side of a search.
struct Sampled {
  int slot, edge;
  Box box;
  Spot middle;
};

// The edge of `other` nearest to the middle of the sampled edge, of those that come near its box, or
// no_edge. Of its own outline the neighbours are left out: there it is that the outline folds. By the distance of chords, not of middles: beside the end of a long edge the middle of a short
// one around the corner may be nearer, and from there no search leads back over the corner.
int nearest_edge(const Curves& curves, int other, const std::vector<Box>& other_edges,
                 const Sampled& own, double skin) {
  const int edges = static_cast<int>(other_edges.size());
  if (!near(own.box, curves.particle[static_cast<std::size_t>(other)], skin)) return Shape::no_edge;
  int nearest = Shape::no_edge;
  double least = std::numeric_limits<double>::max();
  for (std::size_t e = 0; e < other_edges.size(); ++e) {
    if (!near(own.box, other_edges[e], skin)) continue;
    if (other == own.slot && edges_between(own.edge, static_cast<int>(e), edges) < least_fold)
      continue;
    const double distance =
        squared_distance_to_chord(own.middle, curves.edge_points(other, static_cast<int>(e)));
    if (distance < least) {
      least = distance;
      nearest = static_cast<int>(e);
    }
  }
  return nearest;
}

std::vector<EdgeCandidate> candidates_of(const Curves& curves, const Grid& grid, int slot,
                                         double skin) {
  const Box& own = curves.particle[static_cast<std::size_t>(slot)];
  std::vector<int> others;
  grid.around(own, [&](int other) {
    if (near(own, curves.particle[static_cast<std::size_t>(other)], skin)) others.push_back(other);
  });
  std::ranges::sort(others);
  std::vector<std::vector<Box>> other_edges(others.size());
  for (std::size_t o = 0; o < others.size(); ++o) {
    const auto count = curves.bodies.shape_of_slot(others[o]).edges.size();
    for (std::size_t e = 0; e < count; ++e)
      other_edges[o].push_back(curves.edge(others[o], static_cast<int>(e)));
  }
  std::vector<EdgeCandidate> found;
  for (int e = 0; e < static_cast<int>(curves.bodies.shape_of_slot(slot).edges.size()); ++e) {
    const Spot begin = knot(curves.edge_points(slot, e)),
               end = knot(curves.edge_points(slot, e) + 2);
    const Sampled sampled{
        slot, e, curves.edge(slot, e), {0.5 * (begin[0] + end[0]), 0.5 * (begin[1] + end[1])}};
    for (std::size_t o = 0; o < others.size(); ++o) {
      const int start = nearest_edge(curves, others[o], other_edges[o], sampled, skin);
      if (start != Shape::no_edge) found.push_back({slot, e, others[o], start});
    }
  }
  return found;
}

}  // namespace

int edges_between(int a, int b, int edges) {
  const int apart = std::abs(a - b);
  return std::min(apart, edges - apart);
}

std::vector<EdgeCandidate> edge_candidates(const Bodies& bodies, std::span<const double> control,
                                           double skin) {
  if (bodies.slot_of_number.empty()) return {};
  std::vector<int> slots = bodies.slot_of_number;
  std::ranges::sort(slots);
  Curves curves{bodies, control, std::vector<Box>(bodies.slots.size())};
  for (const int s : slots)
    curves.particle[static_cast<std::size_t>(s)] =
        box_of(curves.points(s), bodies.shape_of_slot(s).control_points());
  const Grid grid(curves.particle, slots, skin);

  std::vector<std::vector<EdgeCandidate>> found(slots.size());
  tbb::parallel_for(std::size_t{0}, slots.size(),
                    [&](std::size_t i) { found[i] = candidates_of(curves, grid, slots[i], skin); });
  std::vector<EdgeCandidate> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace pulvis
