// skin_check: whether the contact rows must be rebuilt, in three dimensions: as systems/contact/skin_check.cpp, from how
// far neighbouring surfaces have approached each other since the last rebuild.
//
// Source   systems/space/contact/box.hpp
// Runs     first of the contact systems; does nothing while Clock::travel is below `look_at`
// Active   if there is contact
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "systems/contact/by_slot.hpp"
#include "systems/ranks/border.hpp"
#include "systems/space/contact/box.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {
namespace {

constexpr double min_left = 0.2;  // of the skin: with less, checking costs more than a rebuild

// What the next step may use up, if steps are long compared to the skin.
double look_ahead(const ContactIndex& index, double travel) {
  const double step = travel - index.travel_seen;
  return step > min_left * index.skin ? step : 0;
}

struct SurfaceMotion {  // of a particle since the last rebuild
  Box before, displacement;
};

// From its Bezier points, whose hull contains the surface.
SurfaceMotion motion_of(const double* before, const double* now, int points) {
  const auto at = [](const double* x) { return Box{{x[0], x[1], x[2]}, {x[0], x[1], x[2]}}; };
  SurfaceMotion motion{};
  for (int p = 0; p < points; ++p, before += 3, now += 3) {
    const std::array<double, 3> u{now[0] - before[0], now[1] - before[1], now[2] - before[2]};
    motion = p == 0 ? SurfaceMotion{at(before), at(u.data())}
                    : SurfaceMotion{joined(motion.before, at(before)),
                                    joined(motion.displacement, at(u.data()))};
  }
  return motion;
}

// Remaining skin.
struct Remaining {
  const Bodies& bodies;
  const ContactIndex& index;
  const std::vector<SurfaceMotion>& motion;  // [slots]

  // For particles that were not neighbours: the largest relative motion of any two.
  double of_non_neighbours(const std::vector<int>& slots,
                           const Optional<BorderOutlines<SurfacePosition>>& border) const {
    std::array<double, 6> farthest;
    farthest.fill(-std::numeric_limits<double>::infinity());
    for (const int slot : slots)
      for (std::size_t k = 0; k < 3; ++k) {
        const Box& u = entry(motion, slot).displacement;
        farthest[k] = std::max(farthest[k], -u.low[k]);
        farthest[3 + k] = std::max(farthest[3 + k], u.high[k]);
      }
    maximum_of_ranks(border, farthest);
    Box all;
    for (std::size_t k = 0; k < 3; ++k) {
      all.low[k] = -farthest[k];
      all.high[k] = farthest[3 + k];
    }
    return index.neighbourhood - index.reach - kernels::closing(all, all);
  }
  double of_neighbours(int slot) const {
    double minimum = 1e300;
    if (index.neighbour_begin.empty()) return minimum;
    const SurfaceMotion& own = entry(motion, slot);
    for (int k = entry(index.neighbour_begin, slot); k < entry(index.neighbour_begin, slot + 1);
         ++k) {
      const int other = entry(index.neighbours, k);
      if (other < slot && bodies.owns(other)) continue;  // handled from the other side
      const SurfaceMotion& its = entry(motion, other);
      const double allowed =
          std::max(index.skin, kernels::gap(own.before, its.before) - index.reach);
      minimum = std::min(minimum, allowed - kernels::closing(own.displacement, its.displacement));
    }
    return minimum;
  }
  // Towards a plane only motion against its normal counts, so that a compact may slide along it; towards other tools all
  // relative motion counts.
  double of_tools(const ToolSurfaces& tools, int slot) const {
    double minimum = 1e300;
    for (int t = 0; t < tools.position.rows(); ++t) {
      const Point& before = entry(index.tools_before, t);
      const Point now = tools.position_of(t);
      const Box own = moved(entry(motion, slot).before, {-before[0], -before[1], -before[2]});
      const Box u = moved(entry(motion, slot).displacement,
                          {before[0] - now[0], before[1] - now[1], before[2] - now[2]});
      const Point normal = tools.normal_of(t);
      const bool plane = tools.shape(t).kind == ToolShapes::Kind::plane;
      const double allowed =
          plane ? std::max(index.skin, kernels::min_along(own, normal) - index.reach) : index.skin;
      minimum = std::min(minimum, allowed + (plane ? std::min(kernels::min_along(u, normal), 0.0)
                                                   : -kernels::closing(u, Box{})));
    }
    return minimum;
  }
};

}  // namespace

void skin_check::operator()() const {
  index->due = false;
  const double ahead = look_ahead(*index, clock->travel);
  index->travel_seen = clock->travel;
  const auto tool_position = [&](int t) {
    const Row<Tool> tool(t);
    return Point3{tools->position(tool, 0), tools->position(tool, 1), tools->position(tool, 2)};
  };
  if (index->travel_at_bin >= 0) {
    if (clock->travel + ahead < index->look_at) return;
    std::vector<SurfaceMotion> motion(bodies.bodies->slots.size());
    const auto& slots = bodies.bodies->own_slots;
    const auto& present = bodies.bodies->present_slots;
    std::vector<double> left(slots.size());
    const Remaining remaining{*bodies.bodies, *index, motion};
    tell_border(border, *bodies.bodies);
    tbb::parallel_for(std::size_t{0}, present.size(), [&](std::size_t i) {
      const std::ptrdiff_t first = bodies.outline_begin(present[i]);
      entry(motion, present[i]) =
          motion_of(before.values().data() + first, position.values().data() + first,
                    bodies.shape_of(present[i]).surface_points());
    });
    tbb::parallel_for(std::size_t{0}, slots.size(), [&](std::size_t i) {
      left[i] = remaining.of_neighbours(slots[i]);
      if (tools) left[i] = std::min(left[i], remaining.of_tools(*tools, slots[i]));
    });
    double minimum = remaining.of_non_neighbours(slots, border);
    for (const double of_slot : left) minimum = std::min(minimum, of_slot);
    minimum = minimum_of_ranks(border, minimum);
    index->look_at = clock->travel + minimum;
    if (minimum > std::max(min_left * index->skin, ahead)) return;
  }
  index->due = true;
  index->travel_at_bin = clock->travel;
  index->look_at = clock->travel + index->skin;
  index->bins += 1;
  for (const int slot : bodies.bodies->own_slots) {
    const auto first = static_cast<std::size_t>(bodies.outline_begin(slot));
    const auto count = 3 * static_cast<std::size_t>(bodies.shape_of(slot).surface_points());
    std::ranges::copy(position.values().subspan(first, count),
                      before.values().begin() + static_cast<std::ptrdiff_t>(first));
  }
  index->tools_before.clear();
  for (int t = 0; tools && t < tools->position.rows(); ++t)
    index->tools_before.push_back(tool_position(t));
}

}  // namespace pulvis::space
