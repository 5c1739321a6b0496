#include "scenes/initial_state.hpp"

#include <set>

#include "components/bond.hpp"
#include "components/cell.hpp"
#include "components/ranks.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/files/checkpoint.hpp"
#include "scenes/ranks/gather.hpp"

namespace pulvis {

void begin_with_state(World& world, const Scene& scene) {
  if (!scene.initial_state) return;
  const double end = world.resource<Clock>().end;
  const Checkpoint state(scene.file.parent_path() / *scene.initial_state);
  const std::set<std::string> anew{ToolProgram::resource_name, StageEnds::resource_name};
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
  MixedControl& control = world.resource<PeriodicCell>().control;
  control.servos = {};
  control.asked = {};
  control.stage = static_cast<std::size_t>(-1);
  control.cut = std::numeric_limits<double>::infinity();
}

}  // namespace pulvis
