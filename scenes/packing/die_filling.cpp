#include "scenes/packing/die_filling.hpp"

#include "engine/result_cache.hpp"
#include "scenes/packing/press.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulvis {
namespace {

constexpr double margin = 2.5e-4;  // of the smallest particle's diameter
constexpr double touching = 1e-3;

// ---- what differs by dimension -----------------------------------------------------------------------
std::int64_t sweeps_to_shake(const DieFilling<TwoD>& order) {
  // For 100 particles; for ten times as many, 1.8 times fewer.
  constexpr double sweeps_of_hundred = 40'000;
  const double hundreds = std::max(1.0, static_cast<double>(order.shape_of.size()) / 100);
  return static_cast<std::int64_t>(sweeps_of_hundred / std::sqrt(std::sqrt(hundreds)));
}

// Shaking takes a few seconds of one core, half a minute for thousands of particles: sweeps times particles.
std::int64_t sweeps_to_shake(const DieFilling<ThreeD>& order) {
  constexpr double work_of_balls = 40e6;
  constexpr double work_of_many = 200e6;
  constexpr double work_of_others = 0.8e6;
  constexpr std::size_t many = 1000;
  const std::size_t count = order.shape_of.size();
  const bool balls = std::ranges::all_of(order.shapes, &space::RigidShape::is_ball);
  const double work = !balls ? work_of_others : count > many ? work_of_many : work_of_balls;
  return static_cast<std::int64_t>(work / static_cast<double>(count)) + 1;
}

template <class D>
PressSteps press_steps() {
  constexpr double hard_in_space = 0.2;  // less does not break a jam in three dimensions
  PressSteps steps;
  if (D::axes == 3) steps.hard_vibration = hard_in_space;
  return steps;
}

// ---- the same for both -------------------------------------------------------------------------------
template <class D>
double smallest_of(const DieFilling<D>& order) {
  double minimum = std::numeric_limits<double>::max();
  for (const auto& shape : order.shapes) minimum = std::min(minimum, shape.diameter);
  return minimum;
}

template <class D>
double content_of(const DieFilling<D>& order) {
  double sum = 0;
  for (const int s : order.shape_of) sum += order.shapes[static_cast<std::size_t>(s)].content;
  return sum;
}

template <class D>
FilledDie<D> pressed(const DieFilling<D>& order) {
  RigidPowder<D> powder(order.shapes, order.shape_of, order.container, margin * smallest_of(order));
  const double content = content_of(order);
  const std::int64_t sweeps = order.shaken ? sweeps_to_shake(order) : 0;
  Press press(powder, {order.min_height, sweeps, order.seed}, press_steps<D>());
  press.run([&](double density) { return order.container.height_at(density, content); });
  FilledDie<D> die{powder.poses(), powder.height(), 0, powder.min_gap(), 0};
  const auto gaps = powder.near_gaps(touching, die.touches);
  for (const auto& own : gaps)
    die.mean_gap += (own[0] + own[1] + own[2]) / (3 * static_cast<double>(gaps.size()));
  return die;
}

}  // namespace

template <class D>
FilledDie<D> fill_die(const DieFilling<D>& order) {
  static ResultCache<DieFilling<D>, FilledDie<D>> cache(32);  // some seeds of some powders
  return cache.get(order, pressed<D>, [](const FilledDie<D>&) { return 1; });
}

template FilledDie<TwoD> fill_die(const DieFilling<TwoD>& order);
template FilledDie<ThreeD> fill_die(const DieFilling<ThreeD>& order);

}  // namespace pulvis
