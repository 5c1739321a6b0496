#include "scenes/setup_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/portable_math.hpp"
#include "scenes/checks/bending_error.hpp"
#include "scenes/checks/bond_checks.hpp"
#include "scenes/checks/servo_warnings.hpp"
#include "scenes/checks/solids/solid_warnings.hpp"
#include "scenes/checks/travel.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/spec/elastic_response.hpp"
#include "scenes/tools/die_sides.hpp"

namespace pulvis {
namespace {

constexpr double quasi_static = 0.01;  // -, maximum fraction of the strength
constexpr double elastic_strain = 0.01;

double strength_of(const MaterialSpec& m) {
  return m.yield_stress.value_or(elastic_strain * m.youngs_modulus);
}

// m/s, allowing for the fraction of the stage taken by the ramps at both ends.
double highest_speed(const MoveSpec& move, double duration) {
  return move.displacement.norm() / (duration * (1 - move.ramp));
}

// A tool that moves away from the powder exerts no pressure.
bool leaves(const ToolSpec& tool, const MoveSpec& move) {
  if (tool.shape == ToolSpec::Shape::constraint) return true;
  if (tool.shape == ToolSpec::Shape::polyline)
    return in_plane(move.displacement).dot(face_normal(tool)) < 0;
  return has_face(tool) && move.displacement.dot(tool.normal) < 0;
}

}  // namespace

std::string too_fast(const Scene& scene, const FastTool& fast, const std::string& tool) {
  if (fast.share <= quasi_static) return "";
  const StageSpec& stage = scene.stages[static_cast<std::size_t>(fast.stage)];
  return fmt::format(
      "stage '{}': tool '{}' moves at up to {:.3g} m/s: the kinetic energy density of the powder "
      "at that speed, {:.2g} MPa, is {:.2g} of the strength of the particles; quasi-static loading "
      "needs <= {:g}, i.e. at most {:.2g} m/s (a duration of {:.2g} s)",
      stage.name, tool, fast.speed, fast.energy / 1e6, fast.share, quasi_static,
      fast.speed * std::sqrt(quasi_static / fast.share),
      stage.duration * std::sqrt(fast.share / quasi_static));
}

namespace {

struct Extent {
  double left = std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();
};

// The room that packings are generated for: for a lattice, its cells.
std::optional<Extent> room_of(const PackingSpec& packing) {
  double width = packing.container.width;
  if (is_lattice(packing)) width = packing.cells[0] * packing.spacing;
  if (packing.kind == PackingSpec::Kind::csv || !(width > 0)) return std::nullopt;
  return Extent{packing.container.corner.x(), packing.container.corner.x() + width};
}

// A wall that is not at the boundary of the packing's room: behind it, or in front of it.
std::string wall_apart(const Scene& scene) {
  const auto die = die_sides(scene);
  if (!die || scene.packings.size() != 1 || scene.initial_state) return "";
  const auto room = room_of(scene.packings.front());
  const ToolSpec& left = scene.tools[static_cast<std::size_t>((*die)[0])];
  const ToolSpec& right = scene.tools[static_cast<std::size_t>((*die)[1])];
  if (!room || left.shape != ToolSpec::Shape::plane || right.shape != ToolSpec::Shape::plane)
    return "";
  const double width = room->right - room->left;
  const double between = right.point.x() - left.point.x();
  const double apart =
      std::max(std::abs(room->left - left.point.x()), std::abs(room->right - right.point.x()));
  constexpr double close = 1e-3;  // -, of the width
  if (apart <= close * width) return "";
  return fmt::format(
      "packing[0] is generated for a die {:.6g} m wide (x = {:.6g} to {:.6g} m), but the walls "
      "'{}' and '{}' are {:.6g} m apart (x = {:.6g} and {:.6g} m)",
      width, room->left, room->right, left.name, right.name, between, left.point.x(),
      right.point.x());
}

}  // namespace

FastTool fast_tool(const Scene& scene, int stage, int tool, double speed) {
  double heaviest = 0, weakest = std::numeric_limits<double>::infinity();
  for (const MaterialSpec& material : scene.materials) {
    heaviest = std::max(heaviest, material.density);
    weakest = std::min(weakest, strength_of(material));
  }
  FastTool fast{stage, tool, speed, 0.5 * heaviest * speed * speed, 0};
  fast.share = fast.energy / weakest;
  return fast;
}

FastTool fastest_tool(const Scene& scene) {
  FastTool fast;
  for (std::size_t s = 0; s < scene.stages.size(); ++s)
    for (const MoveSpec& move : scene.stages[s].moves) {
      const double speed = highest_speed(move, scene.stages[s].duration);
      if (speed <= fast.speed || leaves(scene.tools[static_cast<std::size_t>(move.tool)], move))
        continue;
      fast = fast_tool(scene, static_cast<int>(s), move.tool, speed);
    }
  return fast;
}

namespace {

// Discs whose rings are graded too steeply: at a ratio of 12 a stress inside a pressed disc was off by 59% of 6 P/(pi D t)
// within half its radius, at 2.3 by 12% (docs/accuracy.md).
std::vector<std::string> steep_ring_warnings(const Scene& scene) {
  constexpr double steepest = 3;  // -
  std::vector<std::string> lines;
  for (const ParticleSpec& particle : scene.particles) {
    const auto* mesh = std::get_if<DiscMesh>(&particle.mesh);
    if (mesh == nullptr || mesh->rings < 2) continue;
    const double ratio = portable::pow(mesh->refinement, 1.0 / (mesh->rings - 1));
    if (ratio <= steepest) continue;
    lines.push_back(fmt::format(
        "particle '{}': with mesh.refinement = {:g} and mesh.rings = {}, each ring is {:.3g} times "
        "as thick as the next one outwards, and stresses inside are inaccurate; usual: at most "
        "{:g} "
        "times, i.e. rings >= {}",
        particle.name, mesh->refinement, mesh->rings, ratio, steepest,
        1 + static_cast<int>(
                std::ceil(portable::log(mesh->refinement) / portable::log(steepest)))));
  }
  return lines;
}

}  // namespace

std::vector<std::string> setup_warnings(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::vector<std::string> lines;
  for (auto&& more :
       {scene.in_space() ? space::solid_warnings(scene, bodies) : steep_ring_warnings(scene),
        travel_warnings(scene, bodies), leaving_warnings(scene),
        until_warnings(scene, density_at_start(scene, bodies)), soft_contact_warnings(scene)})
    lines.insert(lines.end(), more.begin(), more.end());
  const FastTool fast = fastest_tool(scene);
  const std::string tool =
      fast.speed > 0 ? scene.tools[static_cast<std::size_t>(fast.tool)].name : "";
  for (const std::string& line : {too_fast(scene, fast, tool), wall_apart(scene)})
    if (!line.empty()) lines.push_back(line);
  return lines;
}

std::vector<std::string> all_warnings(const Scene& scene, const std::vector<BodySpec>& bodies,
                                      const World* world) {
  std::vector<std::string> lines = bending_warnings(scene);
  const auto add = [&](const std::vector<std::string>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
  };
  if (world != nullptr) add(bond_warnings(scene, *world));
  add(setup_warnings(scene, bodies));
  if (world != nullptr) add(servo_warnings(scene, *world));
  return lines;
}

}  // namespace pulvis
