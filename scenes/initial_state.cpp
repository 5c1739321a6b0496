#include "scenes/initial_state.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "components/bond.hpp"
#include "components/cell.hpp"
#include "components/highest_mode.hpp"
#include "components/ranks.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "components/surface.hpp"
#include "engine/entry.hpp"
#include "engine/files/checkpoint.hpp"
#include "scenes/ranks/gather.hpp"

namespace pulvis {
namespace {

// Stages decide these, and those of the state are over.
std::set<std::string> decided_by_stages() {
  std::set<std::string> names{ToolProgram::resource_name, StageEnds::resource_name,
                              ToolServos::resource_name, DrivenWalls::resource_name};
  for (const ComponentInfo& column : {ServoTravel::info, ServoVelocity::info, ServoMass::info,
                                      ServoDragged::info, ServoForce::info})
    names.insert(std::string("tool/") + column.name);
  return names;
}

// The stages move tools from where the state has them.
void start_tools(World& world) {
  if (!world.has<ToolPosition>()) return;
  const double* position = world.column<ToolPosition>().values();
  for (Point3& start : world.resource<ToolProgram>().start) {
    std::copy_n(position, tool_axes, start.begin());
    position += tool_axes;
  }
}

// Constraints hold their nodes where the state has them: travel counts from there.
template <class D>
void start_constraints(World& world) {
  if (!world.has<ConstraintDirection<D>>()) return;
  const Bodies& bodies = world.resource<Bodies>();
  const auto& places = world.column<Position<D>>();
  const std::vector<std::int32_t>& begin = world.resource<ConstraintIndex>().begin;
  const std::int32_t* target = world.column<ConstraintTarget>().values();
  const double* direction = world.column<ConstraintDirection<D>>().values();
  double* origin = world.column<ConstraintOrigin>().values();
  for (int chunk = 0; chunk < bodies.chunks(); ++chunk)
    for (int row = entry(begin, chunk); row < entry(begin, chunk + 1); ++row) {
      const int node = target[3 * row], lane = target[3 * row + 1];
      if (!bodies.owns(chunk * lane_count + lane)) continue;
      const Lane* at = places.lanes() + D::axes * (entry(places.table.chunk_begin, chunk) + node);
      origin[row] = 0;
      for (int k = 0; k < D::axes; ++k) origin[row] += direction[D::axes * row + k] * at[k][lane];
    }
}

template <class D>
void start_cell(World& world) {
  if (!world.has<PeriodicCell<D>>()) return;
  MixedControl& control = world.resource<PeriodicCell<D>>().control;
  control.servos = {};
  control.asked = {};
  control.stage = static_cast<std::size_t>(-1);
  control.cut = std::numeric_limits<double>::infinity();
}

// The mode is that of the state, but its estimate is for the contact of a scene that may have other servos.
void estimate_anew(World& world) {
  if (!world.has<ModeGain>()) return;
  auto& gain = world.column<ModeGain>();
  std::fill_n(gain.values(), gain.bytes() / sizeof(double), 0.0);
}

}  // namespace

void begin_with_state(World& world, const Scene& scene) {
  if (!scene.initial_state) return;
  const double end = world.resource<Clock>().end;
  const Checkpoint state(scene.file.parent_path() / *scene.initial_state);
  const std::set<std::string> anew = decided_by_stages();
  if (world.has<RankLink>())
    restore_share(state, world, anew);
  else
    state.restore(world, anew);
  Clock& clock = world.resource<Clock>();
  // What broke before the state was saved broke before time 0 of this run.
  if (world.has<BondTotals>())
    for (Crack& crack : world.resource<BondTotals>().cracks) crack.time -= clock.time;
  clock.step = 0;
  clock.time = 0;
  clock.end = end;
  clock.next_look = 0;
  estimate_anew(world);
  start_tools(world);
  start_constraints<TwoD>(world);
  start_constraints<ThreeD>(world);
  start_cell<TwoD>(world);
  start_cell<ThreeD>(world);
}

}  // namespace pulvis
