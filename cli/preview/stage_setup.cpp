#include "cli/preview/stage_setup.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/enum_table.hpp"
#include "scenes/spec/dimension_words.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/tools/servo_checks.hpp"

namespace pulvis {
namespace {

using nlohmann::json;

constexpr EnumTable<StageSpec::Kind> stage_kinds{"settle", "compact", "hold",
                                                 "unload", "eject",   "shear"};

json vector_of(const Vec3& v, const Scene& scene) {
  const std::span<const double> components = components_of(scene, v.data());
  return json(std::vector<double>(components.begin(), components.end()));
}

const std::string& tool_name(const Scene& scene, int tool) {
  return scene.tools[static_cast<std::size_t>(tool)].name;
}

bool moves_radially(const Scene& scene, int number) {
  const ToolSpec& tool = scene.tools[static_cast<std::size_t>(number)];
  return tool.shape == ToolSpec::Shape::constraint && tool.holds == ToolSpec::Holds::radial;
}

json move_setup(const Scene& scene, const StageSpec& stage, const MoveSpec& move) {
  json out{{"tool", tool_name(scene, move.tool)},
           {"displacement", vector_of(move.displacement, scene)}};
  // The ramps at both ends take their share of the stage.
  out["speed"] = move.displacement.norm() / (stage.duration * (1 - move.ramp));
  if (moves_radially(scene, move.tool)) out["radial"] = move.displacement.x();
  if (move.stiffness) out["stiffness"] = *move.stiffness;
  return out;
}

json servo_setup(const Scene& scene, const ServoSpec& servo) {
  return {{"tool", tool_name(scene, servo.tool)},
          {"direction", vector_of(direction_of(servo, scene), scene)},
          {"force", servo.force}};
}

json until_setup(const Scene& scene, const UntilSpec& until) {
  json out = json::object();
  if (until.tool) out["tool"] = tool_name(scene, *until.tool);
  if (until.force) out["force"] = *until.force;
  if (until.displacement) out["displacement"] = *until.displacement;
  if (until.relative_density) out["relative_density"] = *until.relative_density;
  return out;
}

json drive_setup(const Scene& scene, const CellDriveSpec& drive) {
  json out = json::object();
  const auto add = [&](const std::string& name, const std::optional<double>& value) {
    if (value) out[name] = *value;
  };
  for (std::size_t part = 0; part < tensor_parts; ++part)
    add(fmt::format("strain_{}", tensor_part_names[part]), drive.strain[part]);
  for (std::size_t part = 0; part < tensor_parts; ++part)
    add(fmt::format("stress_{}", tensor_part_names[part]), drive.stress[part]);
  add("stress_ratio", drive.stress_ratio);
  add("mean_stress", drive.mean_stress);
  if (drive.rotation == Vec3::Zero()) return out;
  if (scene.in_space())
    out["rotation"] = vector_of(drive.rotation, scene);
  else
    out["rotation"] = drive.rotation.z();
  return out;
}

}  // namespace

json stage_setup(const Scene& scene) {
  json stages = json::array();
  for (const StageSpec& stage : scene.stages) {
    json out{{"name", stage.name},
             {"kind", stage_kinds[stage.kind]},
             {"duration", stage.duration},
             {"moves", json::array()},
             {"servos", json::array()}};
    for (const MoveSpec& move : stage.moves) out["moves"].push_back(move_setup(scene, stage, move));
    for (const ServoSpec& servo : stage.servos) out["servos"].push_back(servo_setup(scene, servo));
    if (stage.until) out["until"] = until_setup(scene, *stage.until);
    if (stage.cell) out["cell"] = drive_setup(scene, *stage.cell);
    if (stage.keep_state) out["keep_state"] = true;
    stages.push_back(std::move(out));
  }
  return stages;
}

}  // namespace pulvis
