// The broad phase against brute force: every edge of every particle with every other particle.
#include "systems/contact/broad_phase.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

#include "scenes/meshes/mesh.hpp"

namespace pulvis {
namespace {

// Particles of several shapes and sizes (1 to 4 mm across), some slots empty, and their control points.
struct Heap {
  Bodies bodies;
  std::vector<double> control;
};

std::vector<Shape> shapes_of_all_sizes() {
  std::vector<Shape> shapes;
  for (const double diameter : {1e-3, 4e-3})
    shapes.push_back(
        make_shape({"disc", 0, DiscOutline{diameter}, DiscMesh{8, 1, 1}, false, 0, {}}));
  shapes.push_back(
      make_shape({"plate", 0, RectangleOutline{4e-3, 1e-3}, RectangleMesh{4, 2}, false, 0, {}}));
  return shapes;
}

Point control_point(const Shape& shape, int c) {
  Point y{};
  for (std::int32_t t = shape.curve_begin[static_cast<std::size_t>(c)];
       t < shape.curve_begin[static_cast<std::size_t>(c) + 1]; ++t) {
    const Shape::CurveTerm& term = shape.curve_terms[static_cast<std::size_t>(t)];
    for (std::size_t k = 0; k < 2; ++k)
      y[k] += term.weight * shape.nodes[static_cast<std::size_t>(term.node.value)][k];
  }
  return y;
}

// `chunks` of four slots thrown at random into a square of `width`; overlaps do not matter here.
Heap random_heap(std::uint64_t seed, int chunks, double width) {
  std::mt19937_64 random(seed);
  const auto in = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  Heap heap;
  heap.bodies.shapes = shapes_of_all_sizes();
  for (int slot = 0; slot < 4 * chunks; ++slot) {
    const int kind = slot / 4 % 3;
    const Shape& shape = heap.bodies.shapes[static_cast<std::size_t>(kind)];
    const bool there = random() % 5 != 0;
    const int number =
        there ? static_cast<int>(heap.bodies.slot_of_number.size()) : Bodies::empty_slot;
    heap.bodies.slots.push_back({number, kind, 0, static_cast<int>(heap.control.size()) / 2});
    if (there) heap.bodies.slot_of_number.push_back(slot);
    const double x = in(0, width), y = in(0, width), angle = in(0, 2 * std::numbers::pi);
    const double cosine = std::cos(angle), sine = std::sin(angle);
    for (int c = 0; c < shape.control_points(); ++c) {
      const Point p = control_point(shape, c);
      heap.control.push_back(x + cosine * p[0] - sine * p[1]);
      heap.control.push_back(y + sine * p[0] + cosine * p[1]);
    }
  }
  while (heap.bodies.slots.size() % lane_count != 0)
    heap.bodies.slots.push_back({Bodies::empty_slot, 0, 0, 0});
  heap.bodies.hold_all();
  return heap;
}

using Key = std::tuple<int, int, int>;  // slot, edge, other

Box edge_box(const Heap& heap, int slot, int edge) {
  const int first =
      heap.bodies.slots[static_cast<std::size_t>(slot)].first_control +
      heap.bodies.shape_of_slot(slot).edges[static_cast<std::size_t>(edge)].first_control;
  return box_of(heap.control.data() + 2 * first, 4);
}

int edges_of(const Heap& heap, int slot) {
  return static_cast<int>(heap.bodies.shape_of_slot(slot).edges.size());
}

std::set<Key> brute_force(const Heap& heap, double skin) {
  std::set<Key> found;
  for (const int slot : heap.bodies.slot_of_number)
    for (const int other : heap.bodies.slot_of_number)
      for (int e = 0; e < edges_of(heap, slot); ++e)
        for (int f = 0; f < edges_of(heap, other); ++f)
          if ((slot != other || edges_between(e, f, edges_of(heap, slot)) >= min_fold) &&
              near(edge_box(heap, slot, e), edge_box(heap, other, f), skin))
            found.insert({slot, e, other});
  return found;
}

std::vector<EdgeCandidate> candidates(const Heap& heap, double skin) {
  return edge_candidates(heap.bodies, heap.control, nullptr,
                         particle_neighbours(heap.bodies, heap.control, nullptr, skin), skin)
      .all;
}

Key key_of(const EdgeCandidate& c) { return {c.slot, c.edge, c.other}; }

TEST(BroadPhase, FindsWhatBruteForceFindsAndNothingElse) {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const double skin : {0.0, 1e-5, 3e-4, 5e-3}) {
      const Heap heap = random_heap(seed, 12, 15e-3);
      std::set<Key> found;
      for (const EdgeCandidate& c : candidates(heap, skin)) found.insert(key_of(c));
      EXPECT_GT(found.size(), 50u);
      EXPECT_EQ(found, brute_force(heap, skin)) << "seed " << seed << ", skin " << skin;
    }
}

TEST(BroadPhase, FindsAllWhereOneParticleFlewFarOff) {
  // The grid has at most 4096 cells a side: the heap then stands in the first of them.
  Heap heap = random_heap(4, 6, 8e-3);
  const int last = heap.bodies.slot_of_number.back();
  const auto first =
      static_cast<std::size_t>(heap.bodies.slots[static_cast<std::size_t>(last)].first_control);
  for (std::size_t i = 2 * first; i < heap.control.size(); i += 2) heap.control[i] += 1e3;
  std::set<Key> found;
  for (const EdgeCandidate& c : candidates(heap, 1e-4)) found.insert(key_of(c));
  EXPECT_EQ(found, brute_force(heap, 1e-4));
}

// A point of the chord between the ends of an edge.
std::array<double, 2> on_chord(const Heap& heap, int slot, int edge, double share) {
  const auto slots = static_cast<std::size_t>(slot);
  const int first =
      heap.bodies.slots[slots].first_control +
      heap.bodies.shape_of_slot(slot).edges[static_cast<std::size_t>(edge)].first_control;
  std::array<double, 2> p{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto y = [&](int c) { return heap.control[2 * static_cast<std::size_t>(first + c) + k]; };
    p[k] = (1 - share) * (y(0) + 4 * y(1) + y(2)) / 6 + share * (y(1) + 4 * y(2) + y(3)) / 6;
  }
  return p;
}

TEST(BroadPhase, StartsAtTheNearestOfTheOthersEdges) {
  const Heap heap = random_heap(5, 12, 15e-3);
  const double skin = 3e-4;
  constexpr int samples = 1000;
  const auto distance = [&](const EdgeCandidate& c, int edge) {
    const auto middle = on_chord(heap, c.slot, c.edge, 0.5);
    double minimum = 1;
    for (int i = 0; i <= samples; ++i) {
      const auto p = on_chord(heap, c.other, edge, double(i) / samples);
      minimum = std::min(minimum, std::hypot(p[0] - middle[0], p[1] - middle[1]));
    }
    return minimum;
  };
  for (const EdgeCandidate& c : candidates(heap, skin)) {
    const Box own = edge_box(heap, c.slot, c.edge);
    // Around a corner the nearest of all, whose box may be farther away.
    const bool corners = heap.bodies.shape_of_slot(c.other).edges[0].previous == Shape::no_edge;
    if (c.slot == c.other || !corners) {
      EXPECT_TRUE(near(own, edge_box(heap, c.other, c.start), skin));
    }
    const double nearest = distance(c, c.start);
    for (int f = 0; f < edges_of(heap, c.other); ++f)
      if ((c.slot != c.other || edges_between(c.edge, f, edges_of(heap, c.slot)) >= min_fold) &&
          (near(own, edge_box(heap, c.other, f), skin) || (corners && c.slot != c.other))) {
        EXPECT_LE(nearest, distance(c, f) + 4e-3 / samples);  // half a step of the longest edges
      }
  }
}

TEST(BroadPhase, IsSortedAndFindsEachOnce) {
  for (const double skin : {0.0, 3e-4}) {
    const auto all = candidates(random_heap(6, 12, 15e-3), skin);
    for (std::size_t i = 1; i < all.size(); ++i) EXPECT_LT(key_of(all[i - 1]), key_of(all[i]));
  }
}

TEST(BroadPhase, ReachesBothWays) {
  // Whoever samples another is sampled back: contact has no master.
  std::map<std::pair<int, int>, int> rows;
  for (const EdgeCandidate& c : candidates(random_heap(7, 12, 15e-3), 1e-4))
    ++rows[{c.slot, c.other}];
  EXPECT_GT(rows.size(), 20u);
  for (const auto& [pair, count] : rows) EXPECT_TRUE(rows.contains({pair.second, pair.first}));
}

TEST(BroadPhase, WiderSkinLosesNothing) {
  const Heap heap = random_heap(8, 12, 15e-3);
  std::set<Key> wide;
  for (const EdgeCandidate& c : candidates(heap, 2e-4)) wide.insert(key_of(c));
  const auto narrow = candidates(heap, 1e-4);
  EXPECT_LT(narrow.size(), wide.size());
  for (const EdgeCandidate& c : narrow) EXPECT_TRUE(wide.contains(key_of(c)));
}

TEST(BroadPhase, EmptySlotsTouchNobody) {
  const Heap heap = random_heap(9, 12, 15e-3);
  EXPECT_LT(heap.bodies.slot_of_number.size(), heap.bodies.slots.size());
  for (const EdgeCandidate& c : candidates(heap, 5e-3)) {
    EXPECT_NE(heap.bodies.slots[static_cast<std::size_t>(c.slot)].number, Bodies::empty_slot);
    EXPECT_NE(heap.bodies.slots[static_cast<std::size_t>(c.other)].number, Bodies::empty_slot);
  }
  EXPECT_TRUE(particle_neighbours(Bodies{}, {}, nullptr, 1e-3).all.empty());
  EXPECT_TRUE(edge_candidates(Bodies{}, {}, nullptr, {{0}, {}}, 1e-3).all.empty());
}

TEST(BroadPhase, SkinIsADistanceBetweenBoxes) {
  const Box a{{0, 0}, {1, 1}}, right{{1.5, 0}, {2, 1}}, above{{0, 1.5}, {1, 2}};
  for (const Box& b : {right, above}) {
    EXPECT_TRUE(near(a, b, 0.5) && near(b, a, 0.5));
    EXPECT_FALSE(near(a, b, 0.49) || near(b, a, 0.49));
  }
}

TEST(BroadPhase, BoxHoldsAllPoints) {
  const double points[6] = {1, -2, -3, 5, 0, 7};
  const Box box = box_of(points, 3);
  EXPECT_EQ(box.low[0], -3);
  EXPECT_EQ(box.high[0], 1);
  EXPECT_EQ(box.low[1], -2);
  EXPECT_EQ(box.high[1], 7);
}

}  // namespace
}  // namespace pulvis
