// skin_check: whether the contact rows must be rebuilt: compares how much closer nearby surfaces have come
// since the rows were built with the skin for which they were built.
//
// Clock::travel is an upper bound for any two surfaces. Only when it could be used up, all are checked: then
// common motion (a compact ejected from its die, the upper part of a long one being pressed) and back-and-forth
// motion are excluded. The remaining skin determines the next check.
//
// Source   systems/contact/skin_kernel.hpp
// Runs     first of the contact systems; does nothing while Clock::travel is below `look_at`
// Active   when contact is possible
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <limits>

#include "components/contact.hpp"
#include "components/surface.hpp"
#include "engine/entry.hpp"
#include "systems/contact/skin_kernel.hpp"
#include "systems/contact/surface_search.hpp"
#include "systems/contact/systems.hpp"
#include "systems/ranks/border.hpp"

namespace pulvis {
namespace {

constexpr double min_left = 0.2;  // of the skin: with less left, checking costs more than new rows

// What the next step may use up, if steps are long relative to the skin: surfaces must be found before they
// meet. (A fold of an outline first seen when its sides have passed through each other looks like the back face
// of a thin part.)
double look_ahead(const ContactIndex& index, double travel) {
  const double step = travel - index.travel_seen;
  return step > min_left * index.skin ? step : 0;
}

struct OutlineMotion {  // of the outline in a slot since the rows were built
  Box before, displacement;
};

OutlineMotion motion_of(const double* before, const double* now, int points) {
  OutlineMotion m{box_of(before, points), {}};
  for (int k = 0; k < 2; ++k) {
    m.displacement.low[k] = m.displacement.high[k] = now[k] - before[k];
    for (int i = 1; i < points; ++i) {
      const double u = now[2 * i + k] - before[2 * i + k];
      m.displacement.low[k] = std::min(m.displacement.low[k], u);
      m.displacement.high[k] = std::max(m.displacement.high[k], u);
    }
  }
  return m;
}

// A minimum: bitwise identical in whatever order the threads take the slots.
template <class Left>
double min_of_slots(const std::vector<int>& slots, const Left& left) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, slots.size()), 1e300,
      [&](const Range& range, double minimum) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
          minimum = std::min(minimum, left(slots[i]));
        return minimum;
      },
      [](double a, double b) { return std::min(a, b); });
}

// How far the nearest images have moved relative to their particles.
double displacement_of_images(const ContactIndex& index, const PeriodicCell* cell) {
  double sum = 0;
  for (std::size_t i = 0; cell != nullptr && i < 4; ++i)
    sum += std::abs(cell->vectors.t[i] - index.cell_before[i]);
  return sum;
}

// Motion of the neighbour's image, from its position at that time.
OutlineMotion of_image(const OutlineMotion& m, const ContactIndex& index, const PeriodicCell& cell,
                       int k) {
  const Tensor2 before{index.cell_before};
  const Image& n = entry(index.images, k);
  const Point was = before * n, is = cell.vectors * n;
  return {kernels::moved(m.before, was),
          kernels::moved(m.displacement, {is[0] - was[0], is[1] - was[1]})};
}

// Particles that were not neighbours: the largest relative motion of any two.
double remaining_of_non_neighbours(const ContactIndex& index, const PeriodicCell* cell,
                                   const std::vector<int>& slots,
                                   const std::vector<OutlineMotion>& motion, const Optional<BorderOutlines<CurvePosition>>& border) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::array<double, 4> farthest{none, none, none, none};  // down, left, up, right
  for (const int slot : slots)
    for (std::size_t k = 0; k < 2; ++k) {
      const Box& u = entry(motion, slot).displacement;
      farthest[k] = std::max(farthest[k], -u.low[k]);
      farthest[2 + k] = std::max(farthest[2 + k], u.high[k]);
    }
  maximum_of_ranks(border, farthest);
  const Box all{{-farthest[0], -farthest[1]}, {farthest[2], farthest[3]}};
  return index.neighbourhood - index.reach - kernels::closing(all, all) -
         displacement_of_images(index, cell);
}

double left_of_neighbours(const Bodies& bodies, const ContactIndex& index,
                          const PeriodicCell* cell, const std::vector<OutlineMotion>& motion,
                          int slot) {
  if (index.neighbour_begin.empty()) return 1e300;
  const OutlineMotion& own = entry(motion, slot);
  double minimum = 1e300;
  for (int k = entry(index.neighbour_begin, slot); k < entry(index.neighbour_begin, slot + 1);
       ++k) {
    const int other = entry(index.neighbours, k);
    if (other < slot && bodies.owns(other)) continue;  // handled from the other slot
    const OutlineMotion& stored = entry(motion, other);
    const OutlineMotion its = cell == nullptr ? stored : of_image(stored, index, *cell, k);
    const double allowed = std::max(index.skin, kernels::gap(own.before, its.before) - index.reach);
    minimum = std::min(minimum, allowed - kernels::closing(own.displacement, its.displacement));
  }
  return minimum;
}

// Relative to a plane only motion against its normal counts, so that a compact may slide along it.
double left_of_tools(const ContactIndex& index, const ToolSurfaces& tools, const OutlineMotion& m) {
  double minimum = 1e300;
  for (int t = 0; t < tools.position.rows(); ++t) {
    const Row<Tool> tool(t);
    const Point3& before = entry(index.tools_before, t);
    const Point back{-before[0], -before[1]};
    const Point moved{before[0] - tools.position(tool, 0), before[1] - tools.position(tool, 1)};
    const Box own = kernels::moved(m.before, back), u = kernels::moved(m.displacement, moved);
    if (tools.shapes && !(*tools.shapes)->is(t, ToolShapes::Kind::plane)) {
      if (!(*tools.shapes)->is(t, ToolShapes::Kind::polyline)) continue;
      const bool far =
          pieces_near((*tools.shapes)->surface_of(t), own, index.neighbourhood).empty();
      const double allowed = far ? index.neighbourhood - index.reach : index.skin;
      minimum = std::min(minimum, allowed - kernels::closing(u, Box{{0, 0}, {0, 0}}));
      continue;
    }
    const Point normal{tools.normal(tool, 0), tools.normal(tool, 1)};
    minimum =
        std::min(minimum, std::max(index.skin, kernels::min_along(own, normal) - index.reach) +
                              kernels::min_along(u, normal));
  }
  return minimum;
}

}  // namespace

void skin_check::operator()() const {
  index->due = false;
  const double ahead = look_ahead(*index, clock->travel);
  index->travel_seen = clock->travel;
  if (index->travel_at_bin >= 0) {
    if (clock->travel + ahead < index->look_at) return;
    std::vector<OutlineMotion> motion(bodies->slots.size());
    const auto& slots = bodies->own_slots;
    const auto& present = bodies->present_slots;
    tell_border(border, *bodies);
    tbb::parallel_for(std::size_t{0}, present.size(), [&](std::size_t i) {
      const int first = 2 * entry(bodies->slots, present[i]).first_control;
      entry(motion, present[i]) =
          motion_of(before.values().data() + first, control.values().data() + first,
                    bodies->shape_of_slot(present[i]).control_points());
    });
    const PeriodicCell* periodic = cell ? &**cell : nullptr;
    double left = remaining_of_non_neighbours(*index, periodic, slots, motion, border);
    left = std::min(left, min_of_slots(slots, [&](int slot) {
                      return left_of_neighbours(*bodies, *index, periodic, motion, slot);
                    }));
    if (tools)
      left = std::min(left, min_of_slots(slots, [&](int slot) {
                        return left_of_tools(*index, *tools, entry(motion, slot));
                      }));
    left = minimum_of_ranks(border, left);
    index->look_at = clock->travel + left;
    if (left > std::max(min_left * index->skin, ahead)) return;
  }
  index->due = true;
  index->travel_at_bin = clock->travel;
  index->look_at = clock->travel + index->skin;
  index->bins += 1;
  for (const int slot : bodies->own_slots) {
    const auto first = 2 * static_cast<std::size_t>(entry(bodies->slots, slot).first_control);
    const auto count = 2 * static_cast<std::size_t>(bodies->shape_of_slot(slot).control_points());
    std::ranges::copy(control.values().subspan(first, count), before.values().begin() + first);
  }
  index->tools_before.clear();
  for (int t = 0; tools && t < tools->position.rows(); ++t)
    index->tools_before.push_back({tools->position(Row<Tool>(t), 0),
                                   tools->position(Row<Tool>(t), 1),
                                   tools->position(Row<Tool>(t), 2)});
}

}  // namespace pulvis
