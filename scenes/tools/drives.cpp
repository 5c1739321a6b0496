#include "scenes/tools/drives.hpp"

#include "scenes/tools/die_relief.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/access.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/spec/tool_motion.hpp"
#include "scenes/tools/cell.hpp"
#include "scenes/tools/die_cell.hpp"
#include "scenes/tools/powder.hpp"
#include "scenes/tools/servo_checks.hpp"
#include "scenes/tools/tool_drive.hpp"

namespace pulvis {
namespace {

ToolProgram tool_program(const World& world, const Scene& scene) {
  ToolProgram program;
  const double* start = scene.tools.empty() ? nullptr : world.column<ToolPosition>().values();
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    program.names.push_back(scene.tools[t].name);
    const double* at = start + tool_axes * t;
    program.start.push_back({at[0], at[1], at[2]});
  }
  double begin = 0;
  for (const StageSpec& stage : scene.stages) {
    const int number = static_cast<int>(program.stages.size());
    for (const MoveSpec& move : stage.moves)
      program.segments.push_back(
          {move.tool, begin, stage.duration, move.ramp, values_of(move.displacement), number});
    program.stages.push_back({stage.name, begin, begin + stage.duration});
    begin += stage.duration;
  }
  return program;
}

// ---- servos ---------------------------------------------------------------------------------------
// Perpendicular to `direction`; particles count as discs of equal area.
double width_of(const Scene& scene, const std::vector<BodySpec>& bodies, const Vec2& direction) {
  double low = 1e300, high = -1e300;
  for (const BodySpec& body : bodies) {
    const auto& outline = scene.particles[static_cast<std::size_t>(body.particle)].outline;
    const double radius = std::sqrt(outline_area(outline) / std::numbers::pi);
    const double at = body.position.x() * direction.y() - body.position.y() * direction.x();
    low = std::min(low, at - radius);
    high = std::max(high, at + radius);
  }
  return high - low;
}

ToolServos tool_servos(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const Powder powder = powder_of(scene, bodies);
  ToolServos servos;
  for (std::size_t s = 0; s < scene.stages.size(); ++s)
    for (const ServoSpec& spec : scene.stages[s].servos) {
      const Vec3 direction = direction_of(spec, scene);
      const double wave =
          powder.impedance * width_of(scene, bodies, in_plane(direction)) * scene.thickness;
      servos.servos.push_back(force_servo(spec, static_cast<int>(s), scene.stages[s].duration,
                                          values_of(direction), {powder.mass, wave}));
    }
  add_elastic_drives(scene.stages, servos);
  servos.make_room(scene.tools.size());
  return servos;
}

// ---- ends -----------------------------------------------------------------------------------------
StageEnds stage_ends(const World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  StageEnds ends;
  ends.ends = early_ends(scene.stages, [&](int number) -> Point3 {
    const ToolSpec& tool = scene.tools[static_cast<std::size_t>(number)];
    if (tool.shape != ToolSpec::Shape::plane) return {};
    return values_of(tool.normal);
  });
  ends.cell.particle_area = powder_of(scene, bodies).area;
  if (const auto cell = die_cell(scene))
    ends.cell = {cell->left,
                 cell->right,
                 cell->bottom,
                 cell->top,
                 ends.cell.particle_area,
                 relief_of(world, cell->bottom)};
  return ends;
}

}  // namespace

void add_drives(World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  world.emplace<ToolProgram>(tool_program(world, scene));
  if (has_servos(scene)) {
    world.add<ServoTravel>();
    world.add<ServoVelocity>();
    world.add<ServoMass>();
    world.add<ServoDragged>();
    world.add<ServoForce>();
    world.emplace<ToolServos>(tool_servos(scene, bodies));
  }
  add_driven_walls(world, scene, bodies);
  if (has_early_ends(scene.stages)) world.emplace<StageEnds>(stage_ends(world, scene, bodies));
}

}  // namespace pulvis
