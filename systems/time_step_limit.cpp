#include "systems/time_step_limit.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "components/space/formulation.hpp"
#include "components/space/shape.hpp"
#include "systems/body/element_bound.hpp"
#include "systems/body/systems.hpp"
#include "systems/space/body/systems.hpp"

namespace pulvis {
namespace {

template <class F>
struct StableStepOf {
  using System = stable_time_step<F::points>;
};
template <class F>
requires(F::Dimension::axes == 3) struct StableStepOf<F> {
  using System = space::stable_time_step<F>;
};

// ---- where an element is ----------------------------------------------------------------------------
const auto& sides_of(const Shape& shape) { return shape.edges; }
const auto& sides_of(const space::Shape& shape) { return shape.faces; }
const auto& elements_of(const Shape& shape) { return shape.quads; }
const auto& elements_of(const space::Shape& shape) { return shape.hexahedra; }

// As many elements meet at a node of a regular grid, or at a face, an edge or a corner of it.
bool is_regular(int axes, bool on_boundary, int elements) {
  if (!on_boundary) return elements == (axes == 2 ? 4 : 8);
  return elements == 1 || elements == 2 || (axes == 3 && elements == 4);
}

template <class AnyShape>
std::string place_of(const AnyShape& shape, int element) {
  constexpr bool in_plane = std::is_same_v<AnyShape, Shape>;
  const auto sides = std::ranges::count_if(
      sides_of(shape), [&](const auto& side) { return side.element == element; });
  std::string place = sides == 0               ? "inside"
                      : in_plane && sides == 1 ? "on the outline"
                      : in_plane               ? "at a corner of the outline"
                      : sides == 1             ? "on the surface"
                      : sides == 2             ? "at an edge of the surface"
                                               : "at a corner of the surface";
  std::vector<int> meet(shape.nodes.size());
  for (const auto& nodes : elements_of(shape))
    for (const Row<Node> n : nodes) entry(meet, n) += 1;
  const bool regular = std::ranges::all_of(entry(elements_of(shape), element), [&](Row<Node> n) {
    return is_regular(in_plane ? 2 : 3, n.value < shape.boundary_nodes, entry(meet, n));
  });
  return regular ? place : place + ", at an irregular node of its mesh";
}

template <class D, class AnyShape>
std::array<double, 3> middle_of(const World& world, ChunkLane at, const AnyShape& shape,
                                int element) {
  const auto& column = world.column<Position<D>>();
  const Lane* x =
      column.lanes() + std::ptrdiff_t{D::axes} * entry(column.table.chunk_begin, at.chunk.index);
  std::array<double, 3> middle{};
  const auto& nodes = entry(elements_of(shape), element);
  for (const Row<Node> n : nodes)
    for (int k = 0; k < D::axes; ++k)
      entry(middle, k) +=
          x[std::ptrdiff_t{D::axes} * n.value + k][at.lane] / static_cast<double>(nodes.size());
  return middle;
}

// ---- what is longer than the step that is taken -------------------------------------------------------
std::string shortened_by(const Clock& clock, double stable) {
  constexpr double changes_between_looks = 0.01;
  const double wanted = clock.safety * stable, left = clock.end - clock.time;
  if (left <= 0 || clock.dt >= (1 - changes_between_looks) * wanted) return {};
  const auto is = [&](double step) { return std::abs(clock.dt - step) <= 1e-12 * step; };
  if (is(left) || is(0.5 * left)) return "the run ends";
  if (clock.step > 0 && is(1.02 * clock.dt_before)) return "steps grow by at most 2%";
  if (clock.step == 0 && clock.stiffening > 1 && clock.dt <= 0.2001 * wanted)
    return "surfaces overlap at the start";
  return "surfaces move fast against the thinnest part that they may touch";
}

// ---- elements and modes -------------------------------------------------------------------------------
int slot_of_shortest(const World& world) {
  const double* stable = world.column<StableTimeStep>().values();
  return *std::ranges::min_element(world.resource<Bodies>().own_slots, {},
                                   [&](int slot) { return stable[slot]; });
}

// The number of the smallest of the lane's values.
int least_of(const std::vector<Lane>& values, int lane) {
  const auto least = std::ranges::min_element(values, {}, [&](const Lane& v) { return v[lane]; });
  return static_cast<int>(least - values.begin());
}

template <class System>
void compare_elements(World& world, const System& system, TimeStepLimit& limit) {
  const Bodies& bodies = world.resource<Bodies>();
  std::vector<double> steps;
  for (const int chunk : bodies.own_chunks) {
    const StableSteps of = system.of_elements(Chunk{chunk});
    for (int lane = 0; lane < lane_count; ++lane)
      if (bodies.owns(chunk * lane_count + lane))
        for (const Lane& step : of.alone) steps.push_back(step[lane]);
  }
  if (steps.empty()) return;
  std::ranges::sort(steps);
  const double shortest = steps.front();
  limit.past_slowest = steps[std::min((steps.size() + 99) / 100, steps.size() - 1)] / shortest;
  limit.median = steps[steps.size() / 2] / shortest;
}

template <class F>
void find_in_mode(World& world, Chunk chunk, int lane, TimeStepLimit& limit) {
  using Inertances = Optional<Read<Inertance>>;
  limit.gain = open<highest_mode<F>>(world).estimate.gain.chunk(chunk)(Row<Particle>(), 0)[lane];
  limit.by_mode =
      limit.gain > 1 && limit.gain < (Inertances(world) ? longest_with_inerters : longest_gain);
  if (!limit.by_mode) return;
  const std::vector<Lane> energies = open<highest_mode<F>>(world).energies(chunk);
  double all = 0;
  for (const Lane& energy : energies) all += energy[lane];
  limit.contact_share = energies.back()[lane] / all;
  const auto most =
      std::max_element(energies.begin(), energies.end() - 1,
                       [&](const Lane& a, const Lane& b) { return a[lane] < b[lane]; });
  limit.element = static_cast<int>(most - energies.begin());
}

template <class F>
TimeStepLimit limit_of(World& world) {
  using D = typename F::Dimension;
  const Clock& clock = world.resource<Clock>();
  const int slot = slot_of_shortest(world);
  const ChunkLane at(slot);
  const Chunk chunk = at.chunk;
  TimeStepLimit limit{
      clock.step, clock.time, clock.dt, world.column<StableTimeStep>().values()[slot], {}, {},
      {},         {},         {}};
  limit.shortened = shortened_by(clock, limit.stable);
  const auto system = open<typename StableStepOf<F>::System>(world);
  const StableSteps steps = system.of_elements(chunk);
  limit.element = least_of(steps.touching, at.lane);
  const double touching = entry(steps.touching, limit.element)[at.lane],
               alone = entry(steps.alone, limit.element)[at.lane];
  limit.contact_share = 1 - touching * touching / (alone * alone);
  limit.without_contact = entry(steps.alone, least_of(steps.alone, at.lane))[at.lane] / touching;
  if (world.has<HighestMode<D>>()) find_in_mode<F>(world, chunk, at.lane, limit);
  const auto& shape = open<ShapedBodies<D>>(world).shape_of(slot);
  limit.particle = entry(world.resource<Bodies>().slots, slot).number;
  limit.particle_class = shape.name;
  limit.place = place_of(shape, limit.element);
  limit.at = middle_of<D>(world, at, shape, limit.element);
  compare_elements(world, system, limit);
  return limit;
}

}  // namespace

double shortest_stable_step(const World& world) {
  return world.column<StableTimeStep>().values()[slot_of_shortest(world)];
}

TimeStepLimit time_step_limit(World& world) {
  const Formulation formulation = world.resource<Bodies>().formulation;
  const auto of = [&]<class F>(F) { return limit_of<F>(world); };
  return world.has<space::Shapes>() ? space::with_hexahedra(formulation, of)
                                    : with_formulation(formulation, of);
}

}  // namespace pulvis
