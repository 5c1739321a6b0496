#include "scenes/space/tool_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "scenes/space/tools/die_room.hpp"
#include "scenes/space/tools/drives.hpp"
#include "scenes/space/tools/powder.hpp"
#include "scenes/spec/space_scene.hpp"
#include "scenes/tools/servo_checks.hpp"

namespace pulvis::space {
namespace {

class ToolsInSpace {
 public:
  ToolsInSpace(const Scene& scene, const schema::Origins& origins, const Refuse& refuse)
      : scene_(scene), space_(*scene.space), origins_(origins), refuse_(refuse) {}

  void run() {
    for (std::size_t t = 0; t < space_.tools.size(); ++t)
      if (space_.tools[t].shape == ToolSpec::Shape::punch)
        profile(space_.tools[t], fmt::format("tool[{}].profile", t));
    for (std::size_t s = 0; s < scene_.stages.size(); ++s) {
      const std::string path = fmt::format("stage[{}]", s);
      moves(scene_.stages[s].moves, path);
      elastic_moves(s, path);
      servos(s, path);
      if (!scene_.stages[s].until) continue;
      until(*scene_.stages[s].until, path + ".until");
      check_travel(*scene_.stages[s].until, scene_.stages[s].moves, scene_.stages[s].servos,
                   path + ".until", refuse_);
    }
  }

 private:
  bool given(const std::string& path) const { return origins_.contains(path); }
  const std::string& name_of(int tool) const {
    return space_.tools[static_cast<std::size_t>(tool)].name;
  }

  // From the axis outward, to the full width of the punch.
  void profile(const ToolSpec& tool, const std::string& path) {
    if (tool.profile.empty()) return;
    if (tool.profile.front().x() != 0)
      return refuse_(
          path, fmt::format("starts {:g} m from the axis, allowed: a first point [\"0 m\", ..]",
                            tool.profile.front().x()));
    for (std::size_t i = 1; i < tool.profile.size(); ++i)
      if (!(tool.profile[i].x() > tool.profile[i - 1].x()))
        return refuse_(path, fmt::format("point {} is not farther from the axis than the one "
                                         "before it, allowed: increasing distances",
                                         i));
    const double end = tool.profile.back().x(), radius = tool.diameter / 2;
    if (std::abs(end - radius) > 1e-9 * radius)
      refuse_(path, fmt::format("ends {:g} m from the axis, allowed: at half the diameter, {:g} m",
                                end, radius));
  }

  void moves(const std::vector<MoveSpec>& moves, const std::string& stage) {
    std::set<int> moved;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      const std::string path = fmt::format("{}.move[{}]", stage, i);
      if (!moved.insert(moves[i].tool).second)
        refuse_(path + ".tool",
                fmt::format("'{}' is moved twice in this stage, allowed: one move for each tool",
                            name_of(moves[i].tool)));
      if (moves[i].displacement.isZero(0))
        refuse_(path + ".displacement",
                "a move by zero has no effect, allowed: a displacement that is not 0");
    }
  }

  // For moves with a compliant drive.
  void elastic_moves(std::size_t stage, const std::string& stage_path) {
    for (std::size_t i = 0; i < scene_.stages[stage].moves.size(); ++i) {
      const MoveSpec& move = scene_.stages[stage].moves[i];
      if (move.stiffness &&
          std::ranges::count(scene_.stages[stage].servos, move.tool, &ServoSpec::tool) > 0)
        refuse_(fmt::format("{}.move[{}].stiffness", stage_path, i),
                fmt::format("'{}' has a servo in the same stage, allowed: only one of the two",
                            name_of(move.tool)));
    }
  }

  void servos(std::size_t stage, const std::string& stage_path) {
    std::set<int> driven;
    for (std::size_t i = 0; i < scene_.stages[stage].servos.size(); ++i) {
      const ServoSpec& servo = scene_.stages[stage].servos[i];
      const std::string path = fmt::format("{}.servo[{}]", stage_path, i);
      if (!driven.insert(servo.tool).second)
        refuse_(path + ".tool",
                fmt::format("'{}' has two servos in this stage, allowed: one for each tool",
                            name_of(servo.tool)));
      if (servo.rate && given(path + ".rise"))
        refuse_(path + ".rise", "has no effect together with rate, allowed: one of the two");
      const Vec3 direction = space::direction_of(servo, scene_);
      if (direction.isZero(0))
        refuse_(path + ".direction",
                "required key is missing: only planes and punches have a normal, allowed: three "
                "numbers, not all 0");
      const ToolSpec& tool = space_.tools[static_cast<std::size_t>(servo.tool)];
      if (has_face(tool) && pulls_off(scene_, tool.name, direction, tool.normal))
        refuse_(path + ".direction", fmt::format(pulled_off, tool.name));
      for (const MoveSpec& move : scene_.stages[stage].moves)
        if (move.tool == servo.tool && !move.stiffness &&
            std::abs(move.displacement.dot(direction)) > 1e-9 * move.displacement.norm())
          refuse_(
              path + ".tool",
              fmt::format("'{}' is moved along its servo's direction in the same stage, allowed: "
                          "a move across it",
                          name_of(servo.tool)));
    }
  }

  void until(const UntilSpec& until, const std::string& path) {
    const int aims = int{until.force.has_value()} + int{until.displacement.has_value()} +
                     int{until.relative_density.has_value()};
    if (aims != 1)
      return refuse_(
          path + (aims == 0 ? ".force" : ".relative_density"),
          fmt::format("{} of force, displacement and relative_density are given, allowed: one",
                      aims));
    if (until.relative_density && until.tool)
      refuse_(path + ".tool", "has no effect together with relative_density, allowed: without it");
    if (until.relative_density && !die_room(scene_))
      refuse_(path + ".relative_density",
              "there is no die to which it could refer, allowed: with six planes with normals "
              "along +x, "
              "-x, +y, -y, +z and -z, or a round die and a plane or punch at either end");
  }

  const Scene& scene_;
  const SpaceScene& space_;
  const schema::Origins& origins_;
  const Refuse& refuse_;
};

}  // namespace

void check_tools(const Scene& scene, const schema::Origins& origins, const Refuse& refuse) {
  ToolsInSpace(scene, origins, refuse).run();
}

}  // namespace pulvis::space
