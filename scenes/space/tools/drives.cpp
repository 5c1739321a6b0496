#include "scenes/space/tools/drives.hpp"

namespace pulvis::space {

Vec3 direction_of(const ServoSpec& servo, const SpaceScene& scene) {
  const ToolSpec& tool = scene.tools[static_cast<std::size_t>(servo.tool)];
  if (servo.direction) return *servo.direction;
  const bool has_face = tool.shape == ToolSpec::Shape::plane || tool.shape == ToolSpec::Shape::punch;
  return has_face ? tool.normal : Vec3::Zero();
}

}  // namespace pulvis::space
