#include "scenes/packing/die_filling.hpp"

#include "engine/result_cache.hpp"
#include "scenes/packing/press.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulvis {
namespace {

constexpr double margin = 2.5e-4;  // of the smallest particle's diameter
constexpr double sweeps_of_hundred =
    40'000;  // for 100 particles; for ten times as many, 1.8 times fewer
constexpr double touching = 1e-3;

double smallest_of(const DieFilling& order) {
  double minimum = std::numeric_limits<double>::max();
  for (const RigidShape& shape : order.shapes) minimum = std::min(minimum, shape.diameter);
  return minimum;
}

std::int64_t sweeps_to_shake(const DieFilling& order) {
  const double hundreds = std::max(1.0, static_cast<double>(order.shape_of.size()) / 100);
  const auto all = static_cast<std::int64_t>(sweeps_of_hundred / std::sqrt(std::sqrt(hundreds)));
  return static_cast<std::int64_t>(order.time_to_shake * static_cast<double>(all));
}

FilledDie pressed(const DieFilling& order) {
  RigidPowder powder(order.shapes, order.shape_of, order.width, margin * smallest_of(order),
                     order.periodic);
  double area = 0;
  for (const int s : order.shape_of) area += order.shapes[static_cast<std::size_t>(s)].area;
  Press press(powder, {order.min_height, sweeps_to_shake(order), order.seed});
  press.run([&](double density) { return area / (density * order.width); });
  FilledDie die{powder.poses(), powder.height(), 0, powder.min_gap(), 0};
  const auto gaps = powder.near_gaps(touching, die.touches);
  for (const auto& own : gaps)
    die.mean_gap += (own[0] + own[1] + own[2]) / (3 * static_cast<double>(gaps.size()));
  return die;
}

}  // namespace

FilledDie fill_die(const DieFilling& order) {
  static ResultCache<DieFilling, FilledDie> cache(32);  // some seeds of some powders
  return cache.get(order, pressed, [](const FilledDie&) { return 1; });
}

}  // namespace pulvis
