#include "scenes/tools/drives.hpp"

#include "scenes/tools/die_relief.hpp"

#include <algorithm>

#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/access.hpp"
#include "scenes/spec/tool_motion.hpp"
#include "scenes/tools/cell.hpp"
#include "scenes/tools/constraints.hpp"
#include "scenes/tools/die_cell.hpp"
#include "scenes/tools/die_room.hpp"
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
template <class D>
ToolServos tool_servos(const World& world, const Scene& scene,
                       const std::vector<BodySpec>& bodies) {
  const Powder powder = powder_of<D>(world, scene, bodies);
  ToolServos servos;
  for (std::size_t s = 0; s < scene.stages.size(); ++s)
    for (const ServoSpec& spec : scene.stages[s].servos) {
      const Vec3 direction = direction_of(spec, scene);
      const double wave = powder.impedance * section_across<D>(world, scene, bodies, direction) *
                          thickness_of<D>(scene);
      servos.servos.push_back(force_servo(spec, static_cast<int>(s), scene.stages[s].duration,
                                          values_of(direction), {powder.mass, wave}));
    }
  add_elastic_drives(scene.stages, servos);
  servos.make_room(scene.tools.size());
  return servos;
}

template <class D>
void add_servos(World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  world.add<ServoTravel>();
  world.add<ServoVelocity>();
  world.add<ServoMass>();
  world.add<ServoDragged>();
  world.add<ServoForce>();
  world.emplace<ToolServos>(tool_servos<D>(world, scene, bodies));
}

// ---- ends -----------------------------------------------------------------------------------------
// What a relative density refers to: the box between four tools, or a room between planes or in a die.
template <class D>
void set_enclosure(const World& world, const Scene& scene, double content, StageEnds& ends) {
  ends.content = content;
  if constexpr (D::axes == 2) {
    if (const auto cell = die_cell(scene))
      ends.cell = {cell->left, cell->right, cell->bottom, cell->top,
                   relief_of(world, cell->bottom)};
  } else {
    ends.room = die_room(scene);
    if (ends.room) ends.room->particle_volume = content;
  }
}

template <class D>
StageEnds stage_ends(const World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  StageEnds ends;
  ends.ends = early_ends(scene.stages, [&](int number) -> Point3 {
    const ToolSpec& tool = scene.tools[static_cast<std::size_t>(number)];
    return has_face(tool) ? values_of(tool.normal) : Point3{};
  });
  set_enclosure<D>(world, scene, powder_of<D>(world, scene, bodies).content, ends);
  return ends;
}

}  // namespace

void add_tool_columns(World& world, const Scene& scene, bool with_normals) {
  world.add_table<Tool>(scene.tools.size());
  world.add<ToolPosition>();
  world.add<ToolVelocity>();
  if (with_normals) world.add<ToolNormal>();
  world.add<ToolForce>();
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    for (std::size_t k = 0; k < tool_axes; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      if (with_normals)
        world.column<ToolNormal>().values()[tool_axes * t + k] = scene.tools[t].normal[axis];
      world.column<ToolPosition>().values()[tool_axes * t + k] = start_of(scene.tools[t])[axis];
    }
}

template <class D>
void add_drives(World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  world.emplace<ToolProgram>(tool_program(world, scene));
  if (has_servos(scene)) add_servos<D>(world, scene, bodies);
  add_driven_walls<D>(world, scene, bodies);
  if (has_early_ends(scene.stages)) world.emplace<StageEnds>(stage_ends<D>(world, scene, bodies));
}

template void add_drives<TwoD>(World&, const Scene&, const std::vector<BodySpec>&);
template void add_drives<ThreeD>(World&, const Scene&, const std::vector<BodySpec>&);

}  // namespace pulvis
