#include "scenes/checks/process_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "engine/entry.hpp"
#include "scenes/spec/dimension_words.hpp"

namespace pulvis {

namespace {

void check_stage_kind(const Scene& scene, const StageSpec& stage, const std::string& path,
                      const Refuse& refuse) {
  const bool needs_moves =
      stage.kind != StageSpec::Kind::settle && stage.kind != StageSpec::Kind::hold;
  if (needs_moves && stage.moves.empty() && stage.servos.empty() && !stage.cell)
    refuse(path + ".kind",
           fmt::format("no tool moves in this stage, allowed: at least one [[stage.move]] or "
                       "[[stage.servo]]{}, or kind = \"settle\" or \"hold\"",
                       words_of(scene).other_moves));
  if (!needs_moves && !stage.moves.empty())
    refuse(path + ".move[0]",
           "tools do not move in a stage of this kind, allowed: moves in stages of a kind other "
           "than \"settle\" and \"hold\"");
}

// Each has a file, named after the stage.
void check_kept_state(const Scene& scene, std::size_t number, const std::string& path,
                      const Refuse& refuse) {
  const StageSpec& stage = scene.stages[number];
  for (std::size_t k = 0; k < number; ++k)
    if (stage.keep_state && scene.stages[k].keep_state && scene.stages[k].name == stage.name)
      refuse(path + ".name",
             fmt::format("two stages that keep their state are called '{}', allowed: each name "
                         "once",
                         stage.name));
}

}  // namespace

void check_stages(const Scene& scene, const Refuse& refuse) {
  for (std::size_t s = 0; s < scene.stages.size(); ++s) {
    const std::string path = fmt::format("stage[{}]", s);
    check_stage_kind(scene, scene.stages[s], path, refuse);
    check_kept_state(scene, s, path, refuse);
  }
}

namespace {

void refuse_two_tools(const std::string& first, const std::string& second,
                      const std::vector<std::string>& tools, const std::string& path,
                      const Refuse& refuse) {
  const auto is_tool = [&](const std::string& name) {
    return std::ranges::find(tools, name) != tools.end();
  };
  if (is_tool(first) && is_tool(second))
    refuse(path, "two tools never touch, allowed: a material and a tool, or two materials");
}

// A particle has one material, and so have its grains.
void refuse_inside_nothing(const Scene& scene, std::size_t number, const Refuse& refuse) {
  const BondSpec& bond = scene.bonds[number];
  if (!bond.inside) return;
  std::set<std::string> of_grains;
  for (const ParticleSpec& particle : scene.particles)
    if (particle.grains) of_grains.insert(entry(scene.materials, particle.material).name);
  if (bond.first == bond.second && of_grains.contains(bond.first)) return;
  std::string allowed = "false";
  for (const std::string& name : of_grains)
    allowed += fmt::format(", or between = [\"{0}\", \"{0}\"]", name);
  refuse(fmt::format("bond[{}].inside", number),
         fmt::format("it bonds the grains of one particle, but no particle of '{}' and '{}' has "
                     "[particle.grains], allowed: {}",
                     bond.first, bond.second, allowed));
}

}  // namespace

void check_frictions(const Scene& scene, const std::vector<std::string>& tools,
                     const Refuse& refuse) {
  std::set<std::pair<std::string, std::string>> named;
  for (std::size_t i = 0; i < scene.frictions.size(); ++i) {
    const FrictionSpec& friction = scene.frictions[i];
    const std::string path = fmt::format("friction[{}].between", i);
    refuse_two_tools(friction.first, friction.second, tools, path, refuse);
    if (friction.static_coefficient && *friction.static_coefficient < friction.coefficient)
      refuse(fmt::format("friction[{}].static_coefficient", i),
             fmt::format("{:g} is below the dynamic coefficient, allowed: >= {:g}",
                         *friction.static_coefficient, friction.coefficient));
    if (!named.insert(std::minmax(friction.first, friction.second)).second)
      refuse(path, fmt::format("the pair '{}' and '{}' is named twice, allowed: once",
                               friction.first, friction.second));
  }
}

void check_bonds(const Scene& scene, const std::vector<std::string>& tools, const Refuse& refuse) {
  constexpr std::size_t most_bonds = 255;
  std::set<std::tuple<BondSpec::Origin, bool, std::string, std::string>> named;
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    const BondSpec& bond = scene.bonds[i];
    const std::string path = fmt::format("bond[{}].between", i);
    const auto& [first, second] = std::minmax(bond.first, bond.second);
    refuse_two_tools(first, second, tools, path, refuse);
    if (!named.insert({bond.origin, bond.inside, first, second}).second)
      refuse(path, fmt::format("the pair '{}' and '{}' is named twice with this origin, allowed: "
                               "once",
                               first, second));
    refuse_inside_nothing(scene, i, refuse);
  }
  if (scene.bonds.size() > most_bonds)
    refuse("bond[255]",
           fmt::format("{} are declared, allowed: <= {}", scene.bonds.size(), most_bonds));
}

void refuse_unused(const std::string& path, const std::string& name, const std::string& user,
                   const Refuse& refuse) {
  refuse(path,
         fmt::format("'{}' is declared but not used, allowed: what a {} refers to", name, user));
}

}  // namespace pulvis
