#include "scenes/checks/travel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scenes/checks/enclosed.hpp"
#include "scenes/checks/faces.hpp"
#include "scenes/language/problem.hpp"

namespace pulvis {
namespace {

constexpr double too_dense =
    1.5;  // -, denser scenes are refused; soft elastic solids withstand less

bool is_prescribed(const StageSpec& stage) {
  return stage.servos.empty() && !stage.cell && !stage.until &&
         std::ranges::none_of(stage.moves,
                              [](const MoveSpec& m) { return m.stiffness.has_value(); });
}

// -, fraction of the stage at which the powder fills what is enclosed.
double share_until_full(double powder, const Enclosed& left, const Places& places,
                        const std::vector<MoveSpec>& moves) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (left(tools_moved(places, moves, middle)) > powder ? low : high) = middle;
  }
  return high;
}

FullDensity reached_in(const Scene& scene, int stage, const Enclosed& enclosed,
                       const Places& places, double powder) {
  const std::vector<MoveSpec>& moves = scene.stages[static_cast<std::size_t>(stage)].moves;
  const std::vector<Face> faces = faces_of(scene);
  FullDensity full;
  full.stage = stage;
  for (const MoveSpec& move : moves) {
    const auto face = std::ranges::find(faces, move.tool, &Face::tool);
    const double inwards = face == faces.end() ? 0 : move.displacement.dot(face->normal);
    if (inwards <= full.travel) continue;
    full.tool = move.tool;
    full.travel = inwards;
  }
  full.until_full = share_until_full(powder, enclosed, places, moves) * full.travel;
  const double left = enclosed(tools_moved(places, moves, 1));
  full.density = left > 0 ? powder / left : std::numeric_limits<double>::infinity();
  return full;
}

const std::string& name_of(const Scene& scene, int tool) {
  return scene.tools[static_cast<std::size_t>(tool)].name;
}

std::string described(const Scene& scene, const FullDensity& full) {
  const std::string density = full.density > 100
                                  ? "no volume is left in the die"
                                  : fmt::format("relative density {:.3g}", full.density);
  return fmt::format(
      "stage '{}': tool '{}' travels {:.4g} m, beyond full density, which is reached after {:.4g} "
      "m ({} at the end)",
      scene.stages[static_cast<std::size_t>(full.stage)].name, name_of(scene, full.tool),
      full.travel, full.until_full, density);
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

// The move of the tool in the stage.
[[noreturn]] void refuse_move(const Scene& scene, int stage, int tool, const std::string& message) {
  const auto& moves = scene.stages[static_cast<std::size_t>(stage)].moves;
  const auto move = std::ranges::find(moves, tool, &MoveSpec::tool);
  throw SceneError(
      {{scene.file_of(move->mark).string(), move->mark.line, move->mark.column, "",
        fmt::format("stage[{}].move[{}].displacement", stage, move - moves.begin()), message}});
}

void refuse_meeting(const Scene& scene, const Meeting& meeting) {
  refuse_move(scene, meeting.stage, meeting.first,
              fmt::format("stage '{}': tools '{}' and '{}' approach each other by {:.4g} m, but "
                          "are {:.4g} m apart at its start: no room is left for the powder, "
                          "allowed: less than {:.4g} m",
                          scene.stages[static_cast<std::size_t>(meeting.stage)].name,
                          name_of(scene, meeting.first), name_of(scene, meeting.second),
                          meeting.closing, meeting.apart, meeting.apart));
}

// For scenes that demonstrate what a health check detects.
bool is_to_stop(const Scene& scene) {
  return std::ranges::any_of(scene.expects, &ExpectSpec::stops);
}

}  // namespace

std::optional<double> density_at_start(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const auto left = enclosed(scene);
  const double content = left ? (*left)(tools_at_start(scene)) : 0;
  return content > 0 ? std::optional(content_of_powder(scene, bodies) / content) : std::nullopt;
}

std::optional<FullDensity> full_density(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const auto left = enclosed(scene);
  if (!left) return std::nullopt;
  const double powder = content_of_powder(scene, bodies);
  Places places = tools_at_start(scene);
  for (std::size_t s = 0; s < scene.stages.size(); ++s) {
    if (!is_prescribed(scene.stages[s])) return std::nullopt;
    const Places end = tools_moved(places, scene.stages[s].moves, 1);
    const double content = (*left)(end);
    if (content < powder && content < (*left)(places))
      return reached_in(scene, static_cast<int>(s), *left, places, powder);
    places = end;
  }
  return std::nullopt;
}

void check_travel(const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (is_to_stop(scene)) return;
  const auto full = full_density(scene, bodies);
  if (!full && !scene.initial_state)
    if (const auto meeting = first_meeting(faces_of(scene), moves_of(scene)))
      refuse_meeting(scene, *meeting);
  if (!full || full->density < too_dense) return;
  refuse_move(scene, full->stage, full->tool,
              fmt::format("{}, allowed: a travel of up to about {:.4g} m", described(scene, *full),
                          full->until_full));
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
  const std::vector<Face> faces = faces_of(scene);
  const std::vector<StageMoves> moves = moves_of(scene);
  std::vector<std::string> lines;
  for (std::size_t s = 0; s < scene.stages.size(); ++s) {
    const StageSpec& stage = scene.stages[s];
    if (stage.kind != StageSpec::Kind::compact || !stage.servos.empty() || stage.cell) continue;
    if (const auto tool = tool_that_leaves(moves[s], faces))
      lines.push_back(fmt::format(
          "stage '{}': tool '{}' moves away from the powder, and no tool moves towards it: a stage "
          "of kind = \"compact\" that loads nothing (wrong sign of the displacement?)",
          stage.name, name_of(scene, *tool)));
  }
  return lines;
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
