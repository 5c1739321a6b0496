#include "scenes/space/packing/die_filling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/packing/press.hpp"

namespace pulvis::space {
namespace {

constexpr double margin = 2.5e-4;  // of the smallest particle's diameter
constexpr double touching = 1e-3;
constexpr double hard_vibration =
    0.2;  // diameters, between pressings: less does not break a jam in three dimensions
// Shaking takes a few seconds of one core, half a minute for thousands of particles: sweeps times particles.
constexpr double work_of_balls = 40e6;
constexpr double work_of_many = 200e6;
constexpr double work_of_others = 0.8e6;
constexpr std::size_t many = 1000;

double smallest_of(const DieFilling& order) {
  double minimum = std::numeric_limits<double>::max();
  for (const RigidShape& shape : order.shapes) minimum = std::min(minimum, shape.diameter);
  return minimum;
}

std::int64_t sweeps_to_shake(const DieFilling& order) {
  if (!order.shaken) return 0;
  const std::size_t count = order.shape_of.size();
  const bool balls = std::ranges::all_of(order.shapes, &RigidShape::is_ball);
  const double work = !balls ? work_of_others : count > many ? work_of_many : work_of_balls;
  return static_cast<std::int64_t>(work / static_cast<double>(count)) + 1;
}

}  // namespace

double DieFilling::volume() const {
  double sum = 0;
  for (const int s : shape_of) sum += shapes[static_cast<std::size_t>(s)].volume;
  return sum;
}

FilledDie fill_die(const DieFilling& order) {
  RigidPowder powder(order.shapes, order.shape_of, order.container, margin * smallest_of(order));
  const double full = order.volume() / order.container.floor_area();
  Press press(powder, {order.min_height, sweeps_to_shake(order), order.seed},
              {.hard_vibration = hard_vibration});
  press.run([&](double density) { return full / density; });
  FilledDie die{powder.poses(), powder.height(), 0, powder.min_gap(), 0};
  const auto gaps = powder.near_gaps(touching, die.touches);
  for (const auto& own : gaps)
    die.mean_gap += (own[0] + own[1] + own[2]) / (3 * static_cast<double>(gaps.size()));
  return die;
}

}  // namespace pulvis::space
