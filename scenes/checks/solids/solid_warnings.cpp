#include "scenes/checks/solids/solid_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/checks/solids/class_shape.hpp"
#include "scenes/checks/solids/solid_overlaps.hpp"
#include "scenes/checks/solids/thin_walls.hpp"

namespace pulvis::space {
namespace {

// Of dies with a mouth: particles whose centres lie beyond it.
std::vector<std::string> mouth_warnings(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::vector<std::string> lines;
  for (const ToolSpec& die : scene.tools) {
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

std::vector<std::string> solid_warnings(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::vector<std::string> lines = coarse_surface_warnings(scene);
  for (auto&& more : {contact_overlap_warnings(scene, bodies), mouth_warnings(scene, bodies),
                      thin_wall_warnings(scene)})
    lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

}  // namespace pulvis::space
