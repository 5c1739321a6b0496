// skin_check: whether the contact rows must be rebuilt: compares how much closer nearby surfaces have come
// since the rows were built with the skin for which they were built.
//
// Clock::relative_motion is an upper bound for any two surfaces. Only when it could be used up, all are checked: then
// common motion (a compact ejected from its die, the upper part of a long one being pressed) and back-and-forth
// motion are excluded. The remaining skin determines the next check.
//
// Source   systems/contact/skin_kernel.hpp
// Runs     first of the contact systems; does nothing while Clock::relative_motion is below `look_at`
// Active   when contact is possible
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <limits>

#include "components/contact.hpp"
#include "components/space/contact.hpp"
#include "components/space/tools.hpp"
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
double look_ahead(const ContactIndex& index, double relative_motion) {
  const double step = relative_motion - index.motion_seen;
  return step > min_left * index.skin ? step : 0;
}

template <class D>
struct OutlineMotion {  // of the outline in a slot since the rows were built
  BoxOf<D> before, displacement;
};

template <class D>
OutlineMotion<D> motion_of(const double* before, const double* now, int points) {
  OutlineMotion<D> m{box_of_points<D>(before, points), {}};
  for (int k = 0; k < D::axes; ++k) {
    m.displacement.low[k] = m.displacement.high[k] = now[k] - before[k];
    for (int i = 1; i < points; ++i) {
      const double u = now[D::axes * i + k] - before[D::axes * i + k];
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

// ---- periodic images ------------------------------------------------------------------------------
// How far the nearest images have moved relative to their particles.
template <class D>
double displacement_of_images(const ContactIndex& index, const PeriodicCell<D>* cell) {
  double sum = 0;
  for (std::size_t i = 0; cell != nullptr && i < cell->vectors.t.size(); ++i)
    sum += std::abs(cell->vectors.t[i] - index.cell_before[i]);
  return sum;
}

// Motion of the k-th neighbour's image, from its position at that time.
template <class D>
OutlineMotion<D> of_image(const OutlineMotion<D>& m, const ContactIndex& index,
                          const PeriodicCell<D>* cell, int k) {
  if (cell == nullptr) return m;
  Tensor<D> before;
  std::ranges::copy(index.cell_before, before.t.begin());
  ImageIn<D> image;
  for (std::size_t i = 0; i < D::axes; ++i)
    image[i] = index.images[D::axes * static_cast<std::size_t>(k) + i];
  const typename D::Point was = before * image, is = cell->vectors * image;
  typename D::Point moved_by;
  for (std::size_t i = 0; i < D::axes; ++i) moved_by[i] = is[i] - was[i];
  return {moved(m.before, was), moved(m.displacement, moved_by)};
}

// ---- tools ----------------------------------------------------------------------------------------
// `m`: relative to the tool. To a plane only motion against its normal counts, so that a compact may slide along it.
double left_of_tool(const ContactIndex& index, const ToolSurfaces& tools, int t,
                    const OutlineMotion<TwoD>& m) {
  if (tools.is(t, ToolShapes::Kind::constraint)) return 1e300;
  if (tools.is(t, ToolShapes::Kind::polyline)) {
    const bool far =
        pieces_near((*tools.shapes)->surface_of(t), m.before, index.neighbourhood).empty();
    const double allowed = far ? index.neighbourhood - index.reach : index.skin;
    return allowed - kernels::closing(m.displacement, Box{{0, 0}, {0, 0}});
  }
  const Point normal{tools.normal(Row<Tool>(t), 0), tools.normal(Row<Tool>(t), 1)};
  return std::max(index.skin, kernels::min_along(m.before, normal) - index.reach) +
         kernels::min_along(m.displacement, normal);
}
// Motion away from a plane is not counted: if it were, rows would be rebuilt at other times, and bits change.
double left_of_tool(const ContactIndex& index, const space::ToolSurfaces& tools, int t,
                    const OutlineMotion<ThreeD>& m) {
  if (tools.shape(t).kind == space::ToolShapes::Kind::constraint) return 1e300;
  if (tools.shape(t).kind != space::ToolShapes::Kind::plane)
    return index.skin - kernels::closing(m.displacement, BoxOf<ThreeD>{});
  const space::Point normal = tools.normal_of(t);
  return std::max(index.skin, kernels::min_along(m.before, normal) - index.reach) +
         std::min(kernels::min_along(m.displacement, normal), 0.0);
}

template <class D>
typename D::Point difference(const Point3& a, const Point3& b) {
  typename D::Point by;
  for (std::size_t k = 0; k < D::axes; ++k) by[k] = a[k] - b[k];
  return by;
}

template <class Tools>
Point3 tool_position(const Tools& tools, int t) {
  const Row<Tool> tool(t);
  return {tools.position(tool, 0), tools.position(tool, 1), tools.position(tool, 2)};
}

// ---- what is left of the skin -------------------------------------------------------------------
template <class D>
struct Remaining {
  const skin_check<D>& s;
  const PeriodicCell<D>* cell;
  const std::vector<OutlineMotion<D>>& motion;  // [slots]

  // Particles that were not neighbours: the largest relative motion of any two.
  double of_non_neighbours() const {
    std::array<double, std::size_t{2} * D::axes> farthest;  // against the axes, along them
    farthest.fill(-std::numeric_limits<double>::infinity());
    for (const int slot : s.bodies.bodies->own_slots)
      for (std::size_t k = 0; k < D::axes; ++k) {
        const BoxOf<D>& u = entry(motion, slot).displacement;
        farthest[k] = std::max(farthest[k], -u.low[k]);
        farthest[D::axes + k] = std::max(farthest[D::axes + k], u.high[k]);
      }
    maximum_of_ranks(s.border, farthest);
    BoxOf<D> all;
    for (std::size_t k = 0; k < D::axes; ++k) {
      all.low[k] = -farthest[k];
      all.high[k] = farthest[D::axes + k];
    }
    return s.index->neighbourhood - s.index->reach - kernels::closing(all, all) -
           displacement_of_images(*s.index, cell);
  }

  double of_neighbours(int slot) const {
    const ContactIndex& index = *s.index;
    double minimum = 1e300;
    if (index.neighbour_begin.empty()) return minimum;
    const OutlineMotion<D>& own = entry(motion, slot);
    for (int k = entry(index.neighbour_begin, slot); k < entry(index.neighbour_begin, slot + 1);
         ++k) {
      const int other = entry(index.neighbours, k);
      if (other < slot && s.bodies.bodies->owns(other)) continue;  // handled from the other slot
      const OutlineMotion<D> its = of_image(entry(motion, other), index, cell, k);
      const double allowed =
          std::max(index.skin, kernels::gap(own.before, its.before) - index.reach);
      minimum = std::min(minimum, allowed - kernels::closing(own.displacement, its.displacement));
    }
    return minimum;
  }

  double of_tools(int slot) const {
    const auto& tools = *s.tools;
    const Point3 origin{};
    double minimum = 1e300;
    for (int t = 0; t < tools.position.rows(); ++t) {
      const Point3& before = entry(s.index->tools_before, t);
      const OutlineMotion<D>& own = entry(motion, slot);
      const OutlineMotion<D> relative{
          moved(own.before, difference<D>(origin, before)),
          moved(own.displacement, difference<D>(before, tool_position(tools, t)))};
      minimum = std::min(minimum, left_of_tool(*s.index, tools, t, relative));
    }
    return minimum;
  }
};

template <class D>
double remaining_skin(const skin_check<D>& s) {
  const Bodies& bodies = *s.bodies.bodies;
  std::vector<OutlineMotion<D>> motion(bodies.slots.size());
  tell_border(s.border);
  tbb::parallel_for(std::size_t{0}, bodies.present_slots.size(), [&](std::size_t i) {
    const int slot = bodies.present_slots[i];
    const std::ptrdiff_t first = s.bodies.outline_begin(slot);
    entry(motion, slot) =
        motion_of<D>(s.before.values().data() + first, s.position.values().data() + first,
                     s.bodies.outline_points(slot));
  });
  const Remaining<D> remaining{s, s.cell ? &**s.cell : nullptr, motion};
  const double of_slots = min_of_slots(bodies.own_slots, [&](int slot) {
    const double left = remaining.of_neighbours(slot);
    return s.tools ? std::min(left, remaining.of_tools(slot)) : left;
  });
  return minimum_of_ranks(s.border, std::min(remaining.of_non_neighbours(), of_slots));
}

template <class D>
void keep_positions(const skin_check<D>& s) {
  for (const int slot : s.bodies.bodies->own_slots) {
    const std::ptrdiff_t first = s.bodies.outline_begin(slot);
    const int count = D::axes * s.bodies.outline_points(slot);
    std::copy_n(s.position.values().begin() + first, count, s.before.values().begin() + first);
  }
  s.index->tools_before.clear();
  for (int t = 0; s.tools && t < s.tools->position.rows(); ++t)
    s.index->tools_before.push_back(tool_position(*s.tools, t));
}

}  // namespace

template <class D>
void skin_check<D>::operator()() const {
  index->due = false;
  const double ahead = look_ahead(*index, clock->relative_motion);
  index->motion_seen = clock->relative_motion;
  if (index->motion_at_bin >= 0) {
    if (clock->relative_motion + ahead < index->look_at) return;
    const double left = remaining_skin(*this);
    index->look_at = clock->relative_motion + left;
    if (left > std::max(min_left * index->skin, ahead)) return;
  }
  index->due = true;
  index->motion_at_bin = clock->relative_motion;
  index->look_at = clock->relative_motion + index->skin;
  index->bins += 1;
  keep_positions(*this);
}
template struct skin_check<TwoD>;
template struct skin_check<ThreeD>;

}  // namespace pulvis
