#include "scenes/space/tools/drives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/body.hpp"
#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "components/space/body.hpp"
#include "components/space/shape.hpp"
#include "engine/access.hpp"
#include "scenes/space/tools/die_room.hpp"
#include "scenes/space/tools/powder.hpp"
#include "scenes/tools/elastic_drive.hpp"
#include "systems/tools/servo_kernel.hpp"

namespace pulvis::space {
namespace {

Point3 values_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

ToolProgram programme_of(const Scene& scene) {
  ToolProgram program;
  for (const ToolSpec& tool : scene.space->tools) {
    program.names.push_back(tool.name);
    program.start.push_back(values_of(tool.point));
  }
  double begin = 0;
  for (std::size_t s = 0; s < scene.stages.size(); ++s) {
    const StageSpec& stage = scene.stages[s];
    for (const MoveSpec& move : scene.space->moves[s])
      program.segments.push_back({move.tool, begin, stage.duration, move.ramp,
                                  values_of(move.displacement), static_cast<int>(s)});
    program.stages.push_back({stage.name, begin, begin + stage.duration});
    begin += stage.duration;
  }
  return program;
}

void add_elastic_drives(const SpaceScene& scene, ToolServos& servos) {
  for (std::size_t s = 0; s < scene.moves.size(); ++s)
    for (const MoveSpec& move : scene.moves[s])
      if (move.stiffness)
        servos.servos.push_back(
            elastic_drive(move, static_cast<int>(s), values_of(move.displacement.normalized())));
}

// `response`: the tool's mass and the one it drags, over the powder's. A solid block of the powder's mass, stiffness and
// cross-section would be damped critically by the latter and the dashpot in series.
ToolServos servos_of(const World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  const Powder powder = powder_of(world, scene);
  ToolServos servos;
  for (std::size_t s = 0; s < scene.stages.size(); ++s)
    for (const ServoSpec& spec : scene.space->servos[s]) {
      const Vec3 direction = direction_of(spec, *scene.space);
      const double wave = powder.impedance * section_across(world, bodies, direction);
      const double tool = spec.response / (1 + kernels::dragged_mass);
      servos.servos.push_back({.tool = spec.tool,
                               .stage = static_cast<int>(s),
                               .direction = values_of(direction),
                               .force = spec.force,
                               .rise = spec.rise * scene.stages[s].duration,
                               .rate = spec.rate.value_or(0),
                               .mass = tool * powder.mass,
                               .damping = 0.5 * std::sqrt(kernels::dragged_mass * tool) * wave,
                               .max_speed = spec.max_speed,
                               .tolerance = spec.tolerance});
    }
  add_elastic_drives(*scene.space, servos);
  return servos;
}

StageEnds::End end_of_stage(const Scene& scene, int stage, const UntilSpec& until) {
  StageEnds::End end{.stage = stage};
  if (until.relative_density) {
    end.kind = StageEnds::Kind::density;
    end.value = *until.relative_density;
    return end;
  }
  end.tool = *until.tool;
  end.kind = until.force ? StageEnds::Kind::force : StageEnds::Kind::displacement;
  end.value = until.force ? *until.force : *until.displacement;
  const ToolSpec& tool = scene.space->tools[static_cast<std::size_t>(end.tool)];
  if (has_face(tool)) end.direction = values_of(tool.normal);
  return end;
}

StageEnds ends_of(const World& world, const Scene& scene) {
  StageEnds ends;
  for (std::size_t s = 0; s < scene.stages.size(); ++s)
    if (scene.stages[s].until)
      ends.ends.push_back(end_of_stage(scene, static_cast<int>(s), *scene.stages[s].until));
  ends.room = die_room(scene);
  if (ends.room) ends.room->particle_volume = powder_of(world, scene).volume;
  return ends;
}

void add_columns_of_tools(World& world, const SpaceScene& scene) {
  world.add_table<Tool>(scene.tools.size());
  world.add<ToolPosition>();
  world.add<ToolVelocity>();
  world.add<ToolNormal>();
  world.add<ToolForce>();
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    for (std::size_t k = 0; k < tool_axes; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      world.column<ToolNormal>().values()[tool_axes * t + k] = scene.tools[t].normal[axis];
      world.column<ToolPosition>().values()[tool_axes * t + k] = scene.tools[t].point[axis];
    }
}

}  // namespace

Vec3 direction_of(const ServoSpec& servo, const SpaceScene& scene) {
  const ToolSpec& tool = scene.tools[static_cast<std::size_t>(servo.tool)];
  if (servo.direction) return *servo.direction;
  return has_face(tool) ? tool.normal : Vec3::Zero();
}

bool has_servos(const SpaceScene& scene) {
  const auto gives = [](const MoveSpec& move) { return move.stiffness.has_value(); };
  return std::ranges::any_of(scene.servos, [](const auto& servos) { return !servos.empty(); }) ||
         std::ranges::any_of(scene.moves,
                             [&](const auto& moves) { return std::ranges::any_of(moves, gives); });
}

void add_tools(World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  const SpaceScene& space = *scene.space;
  if (space.tools.empty()) return;
  add_columns_of_tools(world, space);
  world.emplace<ToolProgram>(programme_of(scene));
  if (has_servos(space)) {
    world.add<ServoTravel>();
    world.add<ServoVelocity>();
    world.add<ServoMass>();
    world.add<ServoDragged>();
    world.add<ServoForce>();
    world.emplace<ToolServos>(servos_of(world, scene, bodies));
  }
  if (std::ranges::any_of(scene.stages, [](const StageSpec& s) { return s.until.has_value(); }))
    world.emplace<StageEnds>(ends_of(world, scene));
}

}  // namespace pulvis::space
