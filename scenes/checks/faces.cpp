#include "scenes/checks/faces.hpp"

#include <algorithm>

#include "scenes/tools/die_sides.hpp"

namespace pulvis {
namespace {

constexpr double parallel = 1e-9;  // 1 - cosine

// Of a plane, or a punch.
Face flat_face_of(const ToolSpec& tool) {
  double deepest = 0;  // m, of the profile
  for (const Vec2& point : tool.profile) deepest = std::min(deepest, point.y());
  return Face{0, tool.point + deepest * tool.normal, tool.normal};
}

std::optional<Face> face_of_drawing(const ToolSpec& tool) {
  if (tool.shape != ToolSpec::Shape::polyline && tool.shape != ToolSpec::Shape::profile)
    return std::nullopt;
  Face face{0, tool.point, in_space(face_normal(tool))};
  for (const Vec2& corner : tool.points)
    if (&corner == &tool.points.front() || (in_space(corner) - face.point).dot(face.normal) < 0)
      face.point = in_space(corner);
  return face;
}

Vec3 displacement_of(const StageMoves& stage, int tool) {
  for (const auto& [moved, displacement] : stage.of_tools)
    if (moved == tool) return displacement;
  return Vec3::Zero();
}

std::optional<Meeting> meeting_in(const StageMoves& stage, const std::vector<Face>& all) {
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const Vec3& n = all[i].normal;
      if (n.dot(all[j].normal) > parallel - 1) continue;
      const double apart = (all[j].point - all[i].point).dot(n);
      const double own = displacement_of(stage, all[i].tool).dot(n);
      const double other = -displacement_of(stage, all[j].tool).dot(n);
      if (apart <= 0 || own + other < apart) continue;
      const bool swapped = other > own;
      return Meeting{0, swapped ? all[j].tool : all[i].tool, swapped ? all[i].tool : all[j].tool,
                     apart, own + other};
    }
  return std::nullopt;
}

}  // namespace

std::vector<Face> faces_of(const Scene& scene) {
  std::vector<Face> all;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    auto face =
        has_face(scene.tools[t]) ? flat_face_of(scene.tools[t]) : face_of_drawing(scene.tools[t]);
    if (!face) continue;
    face->tool = static_cast<int>(t);
    all.push_back(*face);
  }
  return all;
}

std::vector<StageMoves> moves_of(const Scene& scene) {
  std::vector<StageMoves> all;
  for (const StageSpec& stage : scene.stages) {
    StageMoves moves;
    moves.decided = stage.servos.empty() && !stage.cell && !stage.until;
    for (const MoveSpec& move : stage.moves) {
      moves.decided = moves.decided && !move.stiffness;
      moves.of_tools.emplace_back(move.tool, move.displacement);
    }
    all.push_back(std::move(moves));
  }
  return all;
}

std::optional<Meeting> first_meeting(std::vector<Face> all, const std::vector<StageMoves>& stages) {
  for (std::size_t s = 0; s < stages.size() && stages[s].decided; ++s) {
    if (auto meeting = meeting_in(stages[s], all)) {
      meeting->stage = static_cast<int>(s);
      return meeting;
    }
    for (Face& face : all) face.point += displacement_of(stages[s], face.tool);
  }
  return std::nullopt;
}

std::optional<int> tool_that_leaves(const StageMoves& stage, const std::vector<Face>& all) {
  constexpr double across = 1e-9;  // -, of the displacement
  std::optional<int> leaving;
  for (const auto& [tool, displacement] : stage.of_tools) {
    const auto face = std::ranges::find(all, tool, &Face::tool);
    if (face == all.end()) return std::nullopt;
    const double towards = face->normal.dot(displacement);
    if (towards > across * displacement.norm()) return std::nullopt;
    if (towards < -across * displacement.norm()) leaving = tool;
  }
  return leaving;
}

}  // namespace pulvis
