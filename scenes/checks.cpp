#include "scenes/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scenes/tool_checks.hpp"

namespace pulvis {
namespace {

constexpr std::int64_t most_particles = 1'000'000;
constexpr std::int64_t most_quads_a_particle = 1'000'000;
constexpr std::int64_t most_quads = 200'000'000;  // at 600 bytes each: 120 GB

class Checks {
 public:
  Checks(Scene& scene, const schema::Origins& origins, Problems& problems)
      : scene_(scene), origins_(origins), problems_(problems) {}

  void run() {
    something_is_there();
    materials();
    counts();
    spacings();
    stages();
    frictions();
    everything_is_used();
  }

 private:
  document::Origin origin(const std::string& path) const {
    const auto found = origins_.find(path);
    return found == origins_.end() ? document::Origin{{1, 1}, -1} : found->second;
  }

  void refuse(const std::string& path, const std::string& message) {
    problems_.add(origin(path), path, message);
  }

  void refuse_missing(const std::string& key, const std::string& what) {
    problems_.add({{1, 1}, -1}, key, fmt::format("none is declared, allowed: {}", what));
  }

  void something_is_there() {
    if (scene_.materials.empty()) refuse_missing("material", "at least one [[material]]");
    if (scene_.particles.empty()) refuse_missing("particle", "at least one [[particle]]");
    if (scene_.bodies.empty() && scene_.packings.empty())
      refuse_missing("body", "at least one [[body]] or [[packing]]");
    if (scene_.stages.empty()) refuse_missing("stage", "at least one [[stage]]");
  }

  // A yield strain of 1 is far beyond any solid; it is nearly always a wrong prefix (GPa for MPa).
  void materials() {
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      const MaterialSpec& material = scene_.materials[i];
      const std::string path = fmt::format("material[{}].", i);
      if (material.yield_stress && *material.yield_stress >= material.youngs_modulus)
        refuse(path + "yield_stress",
               fmt::format("{:g} Pa is not below Young's modulus, the material would never yield, "
                           "allowed: < {:g} Pa",
                           *material.yield_stress, material.youngs_modulus));
      if (material.hardening_modulus > material.youngs_modulus)
        refuse(path + "hardening_modulus",
               fmt::format("{:g} Pa is above Young's modulus, plastic flow would be stiffer than "
                           "elasticity, allowed: <= {:g} Pa",
                           material.hardening_modulus, material.youngs_modulus));
    }
  }

  static std::int64_t quads(const MeshSpec& mesh) {
    if (const auto* disc = std::get_if<DiscMesh>(&mesh)) {
      const std::int64_t side = disc->boundary_edges / 4;
      return side * side + std::int64_t{disc->rings} * disc->boundary_edges;
    }
    const auto& rectangle = std::get<RectangleMesh>(mesh);
    return std::int64_t{rectangle.columns} * rectangle.rows;
  }

  static std::int64_t count(const SquarePacking& packing) {
    return std::int64_t{packing.rows} * packing.columns;
  }

  std::int64_t quads_of(int particle) const {
    return quads(scene_.particles[static_cast<std::size_t>(particle)].mesh);
  }

  void counts() {
    for (std::size_t i = 0; i < scene_.particles.size(); ++i)
      if (quads(scene_.particles[i].mesh) > most_quads_a_particle)
        refuse(fmt::format("particle[{}].mesh", i),
               fmt::format("the mesh has {} quads, allowed: at most {}",
                           quads(scene_.particles[i].mesh), most_quads_a_particle));
    std::int64_t particles = static_cast<std::int64_t>(scene_.bodies.size());
    std::int64_t total = 0;
    for (const BodySpec& body : scene_.bodies) total += quads_of(body.particle);
    for (std::size_t i = 0; i < scene_.packings.size(); ++i) {
      const std::string path = fmt::format("packing[{}]", i);
      particles += count(scene_.packings[i]);
      if (particles > most_particles) {
        refuse(path, fmt::format("the scene has {} particles up to here, allowed: at most {}",
                                 particles, most_particles));
        return;  // the product below could overflow
      }
      total += count(scene_.packings[i]) * quads_of(scene_.packings[i].particle);
    }
    if (total > most_quads)
      problems_.add(
          {{1, 1}, -1}, "particle",
          fmt::format("all meshes together have {} quads, allowed: at most {}", total, most_quads));
  }

  void spacings() {
    for (std::size_t i = 0; i < scene_.packings.size(); ++i) {
      SquarePacking& packing = scene_.packings[i];
      const std::string path = fmt::format("packing[{}]", i);
      if (origins_.count(path + ".spacing") != 0) continue;
      const Outline& outline = scene_.particles[static_cast<std::size_t>(packing.particle)].outline;
      if (const auto* disc = std::get_if<DiscOutline>(&outline))
        packing.spacing = disc->diameter;
      else
        problems_.add(origin(path), path + ".spacing",
                      "required key is missing: only discs have a spacing of their own, allowed: a "
                      "quantity in m");
    }
  }

  void stages() {
    for (std::size_t i = 0; i < scene_.stages.size(); ++i) {
      const StageSpec& stage = scene_.stages[i];
      const std::string path = fmt::format("stage[{}]", i);
      const bool needs_moves =
          stage.kind != StageSpec::Kind::settle && stage.kind != StageSpec::Kind::hold;
      if (needs_moves && stage.moves.empty())
        refuse(path + ".kind",
               "no tool moves in this stage, allowed: at least one [[stage.move]], or kind = "
               "\"settle\" or \"hold\"");
      if (!needs_moves && !stage.moves.empty())
        refuse(path + ".move[0]",
               "tools stand still in a stage of this kind, allowed: moves in kind = \"compact\", "
               "\"unload\", \"eject\" or \"shear\"");
      moves(stage, path);
    }
  }

  void moves(const StageSpec& stage, const std::string& stage_path) {
    std::set<int> moved;
    for (std::size_t i = 0; i < stage.moves.size(); ++i) {
      const MoveSpec& move = stage.moves[i];
      const std::string path = fmt::format("{}.move[{}]", stage_path, i);
      if (!moved.insert(move.tool).second)
        refuse(path + ".tool",
               fmt::format("'{}' is moved twice in this stage, allowed: one move for each tool",
                           scene_.tools[static_cast<std::size_t>(move.tool)].name));
      if (move.displacement.isZero(0))
        refuse(path + ".displacement",
               "a move by nothing has no effect, allowed: a displacement that is not 0");
    }
  }

  bool is_tool(const std::string& name) const {
    return std::any_of(scene_.tools.begin(), scene_.tools.end(),
                       [&](const ToolSpec& tool) { return tool.name == name; });
  }

  void frictions() {
    std::set<std::pair<std::string, std::string>> named;
    for (std::size_t i = 0; i < scene_.frictions.size(); ++i) {
      const FrictionSpec& friction = scene_.frictions[i];
      const std::string path = fmt::format("friction[{}].between", i);
      if (is_tool(friction.first) && is_tool(friction.second))
        refuse(path, "two tools never touch, allowed: a material and a tool, or two materials");
      if (!named.insert(std::minmax(friction.first, friction.second)).second)
        refuse(path, fmt::format("the pair '{}' and '{}' is named twice, allowed: once",
                                 friction.first, friction.second));
    }
  }

  void everything_is_used() {
    std::set<int> particles, materials;
    for (const BodySpec& body : scene_.bodies) particles.insert(body.particle);
    for (const SquarePacking& packing : scene_.packings) particles.insert(packing.particle);
    for (const ParticleSpec& particle : scene_.particles) materials.insert(particle.material);
    for (std::size_t i = 0; i < scene_.materials.size(); ++i)
      if (materials.count(static_cast<int>(i)) == 0)
        refuse_unused(fmt::format("material[{}]", i), scene_.materials[i].name, "[[particle]]");
    for (std::size_t i = 0; i < scene_.particles.size(); ++i)
      if (particles.count(static_cast<int>(i)) == 0)
        refuse_unused(fmt::format("particle[{}]", i), scene_.particles[i].name,
                      "[[body]] or [[packing]]");
  }

  void refuse_unused(const std::string& path, const std::string& name, const std::string& user) {
    refuse(path,
           fmt::format("'{}' is declared but not used, allowed: what a {} refers to", name, user));
  }

  Scene& scene_;
  const schema::Origins& origins_;
  Problems& problems_;
};

}  // namespace

void complete_and_check(Scene& scene, const schema::Origins& origins, Problems& problems) {
  Checks(scene, origins, problems).run();
  check_tools(scene, origins, problems);
}

}  // namespace pulvis
