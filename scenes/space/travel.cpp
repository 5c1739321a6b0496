#include "scenes/space/travel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "scenes/checks/faces.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/space/packing/rigid_shape.hpp"
#include "scenes/space/tools/die_room.hpp"
#include "scenes/space/tools/powder.hpp"

namespace pulvis::space {
namespace {

constexpr double too_dense =
    1.5;  // -, denser scenes are refused; soft elastic solids withstand less

using Places = std::vector<Vec3>;  // of the tools

double room_left(const DieRoom& room, const Places& places) {
  const auto at = [&](int tool, int k) { return places[static_cast<std::size_t>(tool)][k]; };
  const bool box = room.kind == DieRoom::Kind::box;
  if (!(room.height(at) > 0) || (box && !(room.width(at) > 0 && room.depth(at) > 0))) return 0;
  return std::max(room.volume(at), 0.0);
}

Places start_of_tools(const SpaceScene& scene) {
  Places places;
  for (const ToolSpec& tool : scene.tools) places.push_back(tool.point);
  return places;
}

Places moved(Places places, const std::vector<MoveSpec>& moves, double share) {
  for (const MoveSpec& move : moves)
    places[static_cast<std::size_t>(move.tool)] += share * move.displacement;
  return places;
}

// -, fraction of the stage at which the room equals the powder's volume.
double share_until_full(double volume, const DieRoom& room, const Places& places,
                        const std::vector<MoveSpec>& moves) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (room_left(room, moved(places, moves, middle)) > volume ? low : high) = middle;
  }
  return high;
}

FullDensity reached_by(const std::vector<MoveSpec>& moves, const DieRoom& room,
                       const Places& places, int stage, double volume) {
  const auto farthest = std::ranges::max_element(
      moves, {}, [](const MoveSpec& move) { return move.displacement.norm(); });
  FullDensity full;
  full.stage = stage;
  full.tool = farthest->tool;
  full.travel = farthest->displacement.norm();
  full.until_full = share_until_full(volume, room, places, moves) * full.travel;
  const double left = room_left(room, moved(places, moves, 1));
  full.density = left > 0 ? volume / left : std::numeric_limits<double>::infinity();
  return full;
}

std::string told(const Scene& scene, const FullDensity& full) {
  const std::string density = full.density > 100
                                  ? "no volume is left in the die"
                                  : fmt::format("relative density {:.3g}", full.density);
  return fmt::format(
      "stage '{}': tool '{}' travels {:.4g} m, beyond full density, which is reached after {:.4g} "
      "m ({} at the end)",
      scene.stages[static_cast<std::size_t>(full.stage)].name,
      scene.space->tools[static_cast<std::size_t>(full.tool)].name, full.travel, full.until_full,
      density);
}

std::vector<Face<Vec3>> faces_of(const SpaceScene& scene) {
  std::vector<Face<Vec3>> all;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& tool = scene.tools[t];
    if (!has_face(tool)) continue;
    double deepest = 0;  // m, of a punch's profile
    for (const auto& point : tool.profile) deepest = std::min(deepest, point.y());
    all.push_back({static_cast<int>(t), tool.point + deepest * tool.normal, tool.normal});
  }
  return all;
}

std::vector<StageMoves<Vec3>> moves_of(const Scene& scene) {
  std::vector<StageMoves<Vec3>> all;
  for (std::size_t s = 0; s < scene.stages.size(); ++s) {
    StageMoves<Vec3> moves;
    moves.decided = scene.stages[s].servos.empty() && !scene.stages[s].until;
    for (const MoveSpec& move : scene.stages[s].moves) {
      moves.decided = moves.decided && !move.stiffness;
      moves.of_tools.emplace_back(move.tool, move.displacement);
    }
    all.push_back(std::move(moves));
  }
  return all;
}

[[noreturn]] void refuse_meeting(const Scene& scene, const Meeting& meeting) {
  const auto& moves = scene.stages[static_cast<std::size_t>(meeting.stage)].moves;
  const auto move = std::ranges::find(moves, meeting.first, &MoveSpec::tool);
  const auto name = [&](int tool) {
    return scene.space->tools[static_cast<std::size_t>(tool)].name;
  };
  throw SceneError(
      {{scene.file_of(move->mark).string(), move->mark.line, move->mark.column, "",
        fmt::format("stage[{}].move[{}].displacement", meeting.stage, move - moves.begin()),
        told_meeting(meeting, scene, name(meeting.first), name(meeting.second))}});
}

bool is_to_stop(const Scene& scene) {
  return std::ranges::any_of(scene.expects, &ExpectSpec::stops);
}

}  // namespace

double powder_volume(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::map<int, double> volumes;  // of the classes
  double volume = 0;
  for (const BodySpec& body : bodies) {
    const auto [of_class, fresh] = volumes.try_emplace(body.particle, 0);
    if (fresh)
      of_class->second =
          volume_of(scene.space->particles[static_cast<std::size_t>(body.particle)].shape);
    volume += of_class->second;
  }
  return volume;
}

std::optional<double> density_at_start(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const auto room = die_room(scene);
  const double left = room ? room_left(*room, start_of_tools(*scene.space)) : 0;
  return left > 0 ? std::optional(powder_volume(scene, bodies) / left) : std::nullopt;
}

std::optional<FullDensity> full_density(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const auto room = die_room(scene);
  if (!room) return std::nullopt;
  const double volume = powder_volume(scene, bodies);
  Places places = start_of_tools(*scene.space);
  for (std::size_t s = 0; s < scene.stages.size(); ++s) {
    const std::vector<MoveSpec>& moves = scene.stages[s].moves;
    const bool gives =
        std::ranges::any_of(moves, [](const MoveSpec& move) { return move.stiffness.has_value(); });
    if (gives || !scene.stages[s].servos.empty() || scene.stages[s].until) return std::nullopt;
    const Places end = moved(places, moves, 1);
    const double left = room_left(*room, end);
    if (left < volume && left < room_left(*room, places))
      return reached_by(moves, *room, places, static_cast<int>(s), volume);
    places = end;
  }
  return std::nullopt;
}

void check_travel(const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (is_to_stop(scene)) return;
  const auto full = space::full_density(scene, bodies);
  if (!full && !scene.initial_state)
    if (const auto meeting = first_meeting(faces_of(*scene.space), moves_of(scene)))
      refuse_meeting(scene, *meeting);
  if (!full || full->density < too_dense) return;
  const std::vector<MoveSpec>& moves = scene.stages[static_cast<std::size_t>(full->stage)].moves;
  for (std::size_t m = 0; m < moves.size(); ++m) {
    if (moves[m].tool != full->tool) continue;
    throw SceneError(
        {{scene.file_of(moves[m].mark).string(), moves[m].mark.line, moves[m].mark.column, "",
          fmt::format("stage[{}].move[{}].displacement", full->stage, m),
          fmt::format("{}, allowed: a travel of up to about {:.4g} m", told(scene, *full),
                      full->until_full)}});
  }
}

std::vector<std::string> leaving_warnings(const Scene& scene) {
  const std::vector<Face<Vec3>> faces = faces_of(*scene.space);
  const std::vector<StageMoves<Vec3>> moves = moves_of(scene);
  std::vector<std::string> leaving(scene.stages.size());
  for (std::size_t s = 0; s < leaving.size(); ++s)
    if (scene.stages[s].servos.empty())
      if (const auto tool = tool_that_leaves(moves[s], faces))
        leaving[s] = scene.space->tools[static_cast<std::size_t>(*tool)].name;
  return pulvis::leaving_warnings(scene, leaving);
}

std::vector<std::string> travel_warnings(const Scene& scene, const std::vector<BodySpec>& bodies) {
  constexpr double slightly = 1.02;  // -, what metals bear under a few GPa
  const auto full = space::full_density(scene, bodies);
  if (!full || full->density < slightly) return {};
  return {told(scene, *full) + ": beyond it the solid can only be compressed elastically"};
}

}  // namespace pulvis::space
