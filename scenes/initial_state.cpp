#include "scenes/initial_state.hpp"

#include "components/cell.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/files/checkpoint.hpp"

namespace pulvis {

void begin_with_state(World& world, const Scene& scene) {
  if (!scene.initial_state) return;
  const double end = world.resource<Clock>().end;
  Checkpoint(scene.file.parent_path() / *scene.initial_state)
      .restore(world, {ToolProgram::resource_name, StageEnds::resource_name});
  Clock& clock = world.resource<Clock>();
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
