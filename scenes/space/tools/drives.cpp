#include "scenes/space/tools/drives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/body.hpp"
#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "components/space/shape.hpp"
#include "engine/access.hpp"
#include "scenes/space/tools/powder.hpp"
#include "scenes/spec/tool_motion.hpp"
#include "scenes/tools/constraints.hpp"
#include "scenes/tools/die_room.hpp"
#include "scenes/tools/servo_checks.hpp"
#include "scenes/tools/tool_drive.hpp"

namespace pulvis::space {
namespace {

ToolProgram programme_of(const Scene& scene) {
  ToolProgram program;
  for (const ToolSpec& tool : scene.tools) {
    program.names.push_back(tool.name);
    program.start.push_back(values_of(start_of(tool)));
  }
  double begin = 0;
  for (std::size_t s = 0; s < scene.stages.size(); ++s) {
    const StageSpec& stage = scene.stages[s];
    for (const MoveSpec& move : stage.moves)
      program.segments.push_back({move.tool, begin, stage.duration, move.ramp,
                                  values_of(move.displacement), static_cast<int>(s)});
    program.stages.push_back({stage.name, begin, begin + stage.duration});
    begin += stage.duration;
  }
  return program;
}

ToolServos servos_of(const World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  const Powder powder = powder_of(world, scene);
  ToolServos servos;
  for (std::size_t s = 0; s < scene.stages.size(); ++s)
    for (const ServoSpec& spec : scene.stages[s].servos) {
      const Vec3 direction = direction_of(spec, scene);
      const double wave = powder.impedance * section_across(world, bodies, direction);
      servos.servos.push_back(force_servo(spec, static_cast<int>(s), scene.stages[s].duration,
                                          values_of(direction), {powder.mass, wave}));
    }
  add_elastic_drives(scene.stages, servos);
  servos.make_room(scene.tools.size());
  return servos;
}

StageEnds ends_of(const World& world, const Scene& scene) {
  StageEnds ends;
  ends.ends = early_ends(scene.stages, [&](int number) -> Point3 {
    const ToolSpec& tool = scene.tools[static_cast<std::size_t>(number)];
    return has_face(tool) ? values_of(tool.normal) : Point3{};
  });
  ends.room = die_room(scene);
  if (ends.room) ends.room->particle_volume = powder_of(world, scene).volume;
  return ends;
}

void add_columns_of_tools(World& world, const Scene& scene) {
  world.add_table<Tool>(scene.tools.size());
  world.add<ToolPosition>();
  world.add<ToolVelocity>();
  const bool touched = has_contact_tools(scene);
  if (touched) world.add<ToolNormal>();
  world.add<ToolForce>();
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    for (std::size_t k = 0; k < tool_axes; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      if (touched)
        world.column<ToolNormal>().values()[tool_axes * t + k] = scene.tools[t].normal[axis];
      world.column<ToolPosition>().values()[tool_axes * t + k] = start_of(scene.tools[t])[axis];
    }
}

}  // namespace

void add_tools(World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (scene.tools.empty()) return;
  add_columns_of_tools(world, scene);
  world.emplace<ToolProgram>(programme_of(scene));
  if (has_servos(scene)) {
    world.add<ServoTravel>();
    world.add<ServoVelocity>();
    world.add<ServoMass>();
    world.add<ServoDragged>();
    world.add<ServoForce>();
    world.emplace<ToolServos>(servos_of(world, scene, bodies));
  }
  if (has_early_ends(scene.stages)) world.emplace<StageEnds>(ends_of(world, scene));
}

}  // namespace pulvis::space
