// outline_health: stops a run in which the boundary of a particle has passed through itself: where contact was
// not detected, or where there is none: in the hole of a ring, on a round particle that a tool folds.
//
// Law      Just outside a boundary node the winding number of the boundary is zero; one or more if the node is
//          inside another part of its own particle. `limits.penetration` times an edge is allowed, as deep as
//          contacts; in holes, which have no contact, none. An outline that is star-shaped about its middle
//          cannot have passed through itself, which is cheap to check and true of most
// Source   systems/contact/winding_kernel.hpp
// Runs     on sampled steps
// Active   when the scene has tools, or more than one particle
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/contact/by_slot.hpp"
#include "systems/contact/systems.hpp"
#include "systems/contact/winding_kernel.hpp"

namespace pulvis {
namespace {

struct Chord {
  Point a, b;
  double length;       // m, undeformed
  std::int32_t node;   // in a
  std::size_t before;  // the chord that ends there

  Point normal() const {  // outward, of the chord's length
    return {b[1] - a[1], a[0] - b[0]};
  }
};

double product(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1]; }

double distance(const Point& p, const Chord& c) {
  const Point chord{c.b[0] - c.a[0], c.b[1] - c.a[1]}, r{p[0] - c.a[0], p[1] - c.a[1]};
  const double share = std::clamp(product(r, chord) / product(chord, chord), 0.0, 1.0);
  const double x = r[0] - share * chord[0], y = r[1] - share * chord[1];
  return std::sqrt(x * x + y * y);
}

// The boundary of the particle in a slot, the outline first.
class Boundary {
 public:
  Boundary(const Bodies& bodies, int slot, const Read<Position<TwoD>>& x, const Hollows* hollows)
      : shape_(bodies.shape_of_slot(slot)),
        nodes_(x.chunk(ChunkLane(slot).chunk)),
        lane_(ChunkLane(slot).lane) {
    Hollows::Loop outline(static_cast<std::size_t>(shape_.boundary_nodes));
    std::iota(outline.begin(), outline.end(), 0);
    add(outline);
    outline_ = chords_.size();
    if (hollows == nullptr) return;
    for (const Hollows::Loop& loop : entry(hollows->of_shape, entry(bodies.slots, slot).shape))
      add(loop);
  }

  bool is_seen_from_middle() const { return seen_; }
  std::size_t size() const { return chords_.size(); }
  bool in_hole(std::size_t i) const { return i >= outline_; }
  const Chord& operator[](std::size_t i) const { return chords_[i]; }

  // Depth of a chord's start inside another part of the body, m; 0 if outside. At an end that is folded flat,
  // outside is undefined: the adjacent nodes decide.
  double depth(std::size_t i) const {
    const Chord &after = chords_[i], &before = chords_[after.before];
    const Point m = before.normal(), n = after.normal();
    if (product(m, n) <= 0) return 0;
    const double ml = std::sqrt(product(m, m)), nl = std::sqrt(product(n, n));
    const Point out{m[0] / ml + n[0] / nl, m[1] / ml + n[1] / nl};
    int times = 0;
    double minimum = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < chords_.size(); ++k) {
      if (k == i || k == after.before) continue;
      times += kernels::crossing(after.a, out, chords_[k].a, chords_[k].b);
      if (product(out, chords_[k].normal()) < 0)
        minimum = std::min(minimum, distance(after.a, chords_[k]));
    }
    return times > 0 && std::isfinite(minimum) ? minimum : 0;
  }

 private:
  using Nodes = decltype(std::declval<const Read<Position<TwoD>>&>().chunk(Chunk{}));

  Point at(std::int32_t node) const {
    return {nodes_(Row<Node>(node), 0)[lane_], nodes_(Row<Node>(node), 1)[lane_]};
  }

  void add(const Hollows::Loop& loop) {
    const std::size_t first = chords_.size(), count = loop.size();
    Point middle{};
    for (std::size_t i = 0; i < count; ++i) {
      const std::int32_t from = loop[i], to = loop[(i + 1) % count];
      const Point &p = entry(shape_.nodes, from), &q = entry(shape_.nodes, to);
      const double length =
          std::sqrt((q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]));
      chords_.push_back({at(from), at(to), length, from, first + (i + count - 1) % count});
      for (std::size_t k = 0; k < 2; ++k)
        middle[k] += chords_.back().a[k] / static_cast<double>(count);
    }
    seen_ = seen_ && all_seen(middle, first);
  }

  // Seen from `middle`, all chords of the loop turn in one direction, and once around.
  bool all_seen(const Point& middle, std::size_t first) const {
    const double sense = first == 0 ? 1 : -1;
    int times = 0;
    for (std::size_t i = first; i < chords_.size(); ++i) {
      const Point &a = chords_[i].a, &b = chords_[i].b;
      const double turn =
          (a[0] - middle[0]) * (b[1] - middle[1]) - (a[1] - middle[1]) * (b[0] - middle[0]);
      if (!(sense * turn > 0)) return false;
      times += kernels::crossing(middle, {1, 0}, a, b);
    }
    return times == (first == 0 ? 1 : -1);
  }

  const Shape& shape_;
  Nodes nodes_;
  int lane_;
  std::vector<Chord> chords_;
  std::size_t outline_ = 0;
  bool seen_ = true;
};

struct Fault {
  int slot;
  std::int32_t node;
  double depth, allowed;  // m
  bool in_hole;
};

void look_at(const Boundary& boundary, int slot, double limit, std::vector<Fault>& faults) {
  if (boundary.is_seen_from_middle()) return;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const double allowed = boundary.in_hole(i) ? 0 : limit * boundary[i].length;
    const double depth = boundary.depth(i);
    if (depth <= allowed) continue;
    faults.push_back({slot, boundary[i].node, depth, allowed, boundary.in_hole(i)});
    return;
  }
}

}  // namespace

void outline_health::operator()() const {
  const double limit = (rules ? **rules : ContactRules{}).penetration_limit;
  const Hollows* holes = hollows ? &**hollows : nullptr;
  const auto faults = list_by_slot<Fault>(
      static_cast<int>(bodies->slots.size()), [&](int slot, std::vector<Fault>& found) {
        if (!bodies->owns(slot)) return;
        look_at(Boundary(*bodies, slot, position, holes), slot, limit, found);
      });
  if (faults.all.empty()) return;
  const Fault& fault = faults.all.front();
  throw RunFailure(fmt::format(
      "outline_health: particle {} has penetrated itself: node {}, of its {}, is {:.6g} m inside "
      "another part of it at step {}, t = {:.6g} s; allowed {:.6g} m ({})",
      entry(bodies->slots, fault.slot).number, fault.node, fault.in_hole ? "hole" : "outline",
      fault.depth, clock->step, clock->time, fault.allowed,
      fault.in_hole ? "holes have no contact: stop before they close" : "limits.penetration"));
}

}  // namespace pulvis
