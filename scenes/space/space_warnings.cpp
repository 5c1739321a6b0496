#include "scenes/space/space_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/checks/setup_warnings.hpp"
#include "scenes/checks/travel.hpp"
#include "scenes/space/class_shape.hpp"
#include "scenes/space/overlaps.hpp"
#include "scenes/space/thin_walls.hpp"
#include "scenes/space/tools/powder.hpp"
#include "scenes/space/travel.hpp"
#include "scenes/spec/elastic_response.hpp"

namespace pulvis::space {
namespace {

// The fastest prescribed move towards the powder; its speed is 0 if there is none.
FastTool fastest_in_space(const Scene& scene) {
  FastTool fast;
  for (std::size_t s = 0; s < scene.stages.size(); ++s)
    for (const MoveSpec& move : scene.stages[s].moves) {
      const ToolSpec& tool = scene.space->tools[static_cast<std::size_t>(move.tool)];
      const double speed = move.displacement.norm() / (scene.stages[s].duration * (1 - move.ramp));
      const bool leaves = has_face(tool) && move.displacement.dot(tool.normal) < 0;
      if (speed > fast.speed && !leaves)
        fast = fast_tool(scene, static_cast<int>(s), move.tool, speed);
    }
  return fast;
}

// Of dies with a mouth: particles whose centres lie beyond it.
std::vector<std::string> mouth_warnings(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::vector<std::string> lines;
  for (const ToolSpec& die : scene.space->tools) {
    if (!die.height) continue;
    const auto beyond = std::ranges::count_if(bodies, [&](const BodySpec& body) {
      return (body.position - die.point).dot(die.normal) > *die.height;
    });
    if (beyond > 0)
      lines.push_back(fmt::format(
          "{} of {} particles start beyond the mouth of die '{}', which does not hold them: use a "
          "larger height",
          beyond, bodies.size(), die.name));
  }
  return lines;
}

}  // namespace

std::vector<std::string> setup_warnings(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::vector<std::string> lines = coarse_surface_warnings(scene);
  for (std::string& line : contact_overlap_warnings(scene, bodies))
    lines.push_back(std::move(line));
  for (std::string& line : space::travel_warnings(scene, bodies)) lines.push_back(std::move(line));
  for (std::string& line : space::leaving_warnings(scene)) lines.push_back(std::move(line));
  for (std::string& line : until_warnings(scene, space::density_at_start(scene, bodies)))
    lines.push_back(std::move(line));
  for (std::string& line : mouth_warnings(scene, bodies)) lines.push_back(std::move(line));
  for (std::string& line : thin_wall_warnings(scene)) lines.push_back(std::move(line));
  for (std::string& line : soft_contact_warnings(scene)) lines.push_back(std::move(line));
  const FastTool fast = fastest_in_space(scene);
  if (!(fast.speed > 0)) return lines;
  const std::string& name = scene.space->tools[static_cast<std::size_t>(fast.tool)].name;
  if (const std::string line = too_fast(scene, fast, name); !line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace pulvis::space
