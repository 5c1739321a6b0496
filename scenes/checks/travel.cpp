#include "scenes/checks/travel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "scenes/checks/faces.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/tools/die_sides.hpp"

namespace pulvis {
namespace {

constexpr double densest = 1.5;  // -, denser scenes are refused; soft elastic solids withstand less

// For the sides left, right, bottom, top: their x or y.
using Sides = std::array<double, 4>;

double area_of(const Sides& sides) {
  const double width = sides[1] - sides[0], height = sides[3] - sides[2];
  return width > 0 && height > 0 ? width * height : 0;
}

double powder_area(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::map<int, double> areas;  // of the classes
  double area = 0;
  for (const BodySpec& body : bodies) {
    const auto [of_class, fresh] = areas.try_emplace(body.particle, 0);
    if (fresh) of_class->second = outline_area(scene.class_of(body).outline);
    area += of_class->second;
  }
  return area;
}

Vec2 travel_of(const StageSpec& stage, int tool) {
  for (const MoveSpec& move : stage.moves)
    if (move.tool == tool) return in_plane(move.displacement);
  return Vec2::Zero();
}

bool is_prescribed(const StageSpec& stage) {
  return stage.servos.empty() && !stage.cell &&
         std::ranges::none_of(stage.moves,
                              [](const MoveSpec& m) { return m.stiffness.has_value(); });
}

// Four planes around the whole powder, one on each side.
std::optional<DieSides> flat_die(const Scene& scene) {
  if (scene.initial_state || scene.cell) return std::nullopt;
  for (const ToolSpec& tool : scene.tools)
    if (tool.shape != ToolSpec::Shape::plane && tool.shape != ToolSpec::Shape::constraint)
      return std::nullopt;
  return die_sides(scene);
}

Sides start_of(const Scene& scene, const DieSides& die) {
  Sides sides{};
  for (std::size_t s = 0; s < 4; ++s)
    sides[s] = scene.tools[static_cast<std::size_t>(die[s])].point[s < 2 ? 0 : 1];
  return sides;
}

Sides moved(const Sides& sides, const DieSides& die, const StageSpec& stage, double share) {
  Sides result = sides;
  for (std::size_t s = 0; s < 4; ++s) result[s] += share * travel_of(stage, die[s])[s < 2 ? 0 : 1];
  return result;
}

// -, fraction of the stage at which the die's area equals the powder's.
double share_until(double area, const Sides& sides, const DieSides& die, const StageSpec& stage) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (area_of(moved(sides, die, stage, middle)) > area ? low : high) = middle;
  }
  return high;
}

FullDensity reached_in(const Scene& scene, const Sides& sides, const DieSides& die, int number,
                       double area) {
  const StageSpec& stage = scene.stages[static_cast<std::size_t>(number)];
  FullDensity full;
  full.stage = number;
  for (std::size_t s = 0; s < 4; ++s) {
    const double inwards = travel_of(stage, die[s])[s < 2 ? 0 : 1] * (s % 2 == 0 ? 1 : -1);
    if (inwards <= full.travel) continue;
    full.tool = die[s];
    full.travel = inwards;
  }
  full.until_full = share_until(area, sides, die, stage) * full.travel;
  const double left = area_of(moved(sides, die, stage, 1));
  full.density = left > 0 ? area / left : std::numeric_limits<double>::infinity();
  return full;
}

std::string described(const Scene& scene, const FullDensity& full) {
  const std::string density = full.density > 100
                                  ? "no volume is left in the die"
                                  : fmt::format("relative density {:.3g}", full.density);
  return fmt::format(
      "stage '{}': tool '{}' travels {:.4g} m, beyond full density, which is reached after {:.4g} "
      "m ({} at the end)",
      scene.stages[static_cast<std::size_t>(full.stage)].name,
      scene.tools[static_cast<std::size_t>(full.tool)].name, full.travel, full.until_full, density);
}

// Pa, yield stress of the softest particles; infinite for elastic ones.
double yield_of(const Scene& scene) {
  double yield = std::numeric_limits<double>::infinity();
  for (const MaterialSpec& material : scene.materials)
    if (material.yield_stress) yield = std::min(yield, *material.yield_stress);
  return yield;
}

double bulk_modulus(const Scene& scene) {
  double bulk = std::numeric_limits<double>::infinity();
  for (const MaterialSpec& m : scene.materials)
    bulk = std::min(bulk, m.youngs_modulus / (3 * (1 - 2 * m.poissons_ratio)));
  return bulk;
}

std::vector<Face<Vec2>> faces_of(const Scene& scene) {
  std::vector<Face<Vec2>> all;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& tool = scene.tools[t];
    if (tool.shape == ToolSpec::Shape::constraint) continue;
    Face<Vec2> face{static_cast<int>(t), tool.point, face_normal(tool)};
    for (const Vec2& corner : tool.points)
      if (&corner == &tool.points.front() || (corner - face.point).dot(face.normal) < 0)
        face.point = corner;
    all.push_back(face);
  }
  return all;
}

std::vector<StageMoves<Vec2>> moves_of(const Scene& scene) {
  std::vector<StageMoves<Vec2>> all;
  for (const StageSpec& stage : scene.stages) {
    StageMoves<Vec2> moves;
    moves.decided = is_prescribed(stage) && !stage.until;
    for (const MoveSpec& move : stage.moves)
      moves.of_tools.emplace_back(move.tool, in_plane(move.displacement));
    all.push_back(std::move(moves));
  }
  return all;
}

[[noreturn]] void refuse_meeting(const Scene& scene, const Meeting& meeting) {
  const auto& moves = scene.stages[static_cast<std::size_t>(meeting.stage)].moves;
  const auto move = std::ranges::find(moves, meeting.first, &MoveSpec::tool);
  const auto name = [&](int tool) { return scene.tools[static_cast<std::size_t>(tool)].name; };
  throw SceneError(
      {{scene.file_of(move->mark).string(), move->mark.line, move->mark.column, "",
        fmt::format("stage[{}].move[{}].displacement", meeting.stage, move - moves.begin()),
        told_meeting(meeting, scene, name(meeting.first), name(meeting.second))}});
}

// For scenes that demonstrate what a health check detects.
bool is_to_stop(const Scene& scene) {
  return std::ranges::any_of(scene.expects, &ExpectSpec::stops);
}

}  // namespace

std::optional<double> density_at_start(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const auto die = flat_die(scene);
  const double area = die ? area_of(start_of(scene, *die)) : 0;
  return area > 0 ? std::optional(powder_area(scene, bodies) / area) : std::nullopt;
}

std::optional<FullDensity> full_density(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const auto die = flat_die(scene);
  if (!die) return std::nullopt;
  const double area = powder_area(scene, bodies);
  Sides sides = start_of(scene, *die);
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const StageSpec& stage = scene.stages[i];
    if (!is_prescribed(stage)) return std::nullopt;
    const Sides end = moved(sides, *die, stage, 1);
    if (area_of(end) < area && area_of(end) < area_of(sides) && !stage.until)
      return reached_in(scene, sides, *die, static_cast<int>(i), area);
    if (stage.until) return std::nullopt;
    sides = end;
  }
  return std::nullopt;
}

void check_travel(const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (is_to_stop(scene)) return;
  const auto full = full_density(scene, bodies);
  if (!full && !scene.initial_state)
    if (const auto meeting = first_meeting(faces_of(scene), moves_of(scene)))
      refuse_meeting(scene, *meeting);
  if (!full || full->density < densest) return;
  const StageSpec& stage = scene.stages[static_cast<std::size_t>(full->stage)];
  for (std::size_t m = 0; m < stage.moves.size(); ++m) {
    const MoveSpec& move = stage.moves[m];
    if (move.tool != full->tool) continue;
    throw SceneError({{scene.file_of(move.mark).string(), move.mark.line, move.mark.column, "",
                       fmt::format("stage[{}].move[{}].displacement", full->stage, m),
                       fmt::format("{}, allowed: a travel of up to about {:.4g} m",
                                   described(scene, *full), full->until_full)}});
  }
}

std::vector<std::string> until_warnings(const Scene& scene, const std::optional<double>& density) {
  if (!density || scene.stages.empty() || !scene.stages.front().until) return {};
  const StageSpec& first = scene.stages.front();
  const std::optional<double>& wanted = first.until->relative_density;
  if (!wanted || *density < *wanted) return {};
  return {fmt::format(
      "stage '{}' ends as soon as it begins: its relative density is {:.3g} at the start, and it "
      "ends at {:.3g} (stage.until)",
      first.name, *density, *wanted)};
}

std::vector<std::string> leaving_warnings(const Scene& scene) {
  const std::vector<Face<Vec2>> faces = faces_of(scene);
  const std::vector<StageMoves<Vec2>> moves = moves_of(scene);
  std::vector<std::string> leaving(scene.stages.size());
  for (std::size_t s = 0; s < leaving.size(); ++s)
    if (scene.stages[s].servos.empty() && !scene.stages[s].cell)
      if (const auto tool = tool_that_leaves(moves[s], faces))
        leaving[s] = scene.tools[static_cast<std::size_t>(*tool)].name;
  return leaving_warnings(scene, leaving);
}

std::vector<std::string> travel_warnings(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const auto full = full_density(scene, bodies);
  if (!full) return {};
  const double pressure = bulk_modulus(scene) * full->volume_strain();
  constexpr double times_yield = 3;  // nearly dense powder bears this much anyway
  constexpr double elastic = 0.05;   // -, volume strain
  if (full->volume_strain() < elastic && pressure < times_yield * yield_of(scene)) return {};
  return {
      fmt::format("{}: beyond it the solid can only be compressed elastically, at about {:.2g} GPa",
                  described(scene, *full), pressure / 1e9)};
}

}  // namespace pulvis
