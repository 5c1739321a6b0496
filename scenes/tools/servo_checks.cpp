#include "scenes/tools/servo_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scenes/spec/dimension_words.hpp"
#include "scenes/tools/die_cell.hpp"
#include "scenes/tools/die_room.hpp"

namespace pulvis {
namespace {

class ServoChecks {
 public:
  ServoChecks(const Scene& scene, const StageSpec& stage, std::string path,
              const schema::Origins& origins, Problems& problems)
      : scene_(scene),
        stage_(stage),
        path_(std::move(path)),
        origins_(origins),
        problems_(problems) {}

  void run() {
    for (std::size_t i = 0; i < stage_.servos.size(); ++i) {
      const std::string path = fmt::format("{}.servo[{}]", path_, i);
      servo(stage_.servos[i], path);
      for (std::size_t k = 0; k < i; ++k)
        if (stage_.servos[k].tool == stage_.servos[i].tool)
          refuse(path, "tool",
                 fmt::format("'{}' has two servos in this stage, allowed: one for each tool",
                             tool(stage_.servos[i]).name));
      if (stage_.servos[i].rate && given(path + ".rise"))
        refuse(path, "rise", "has no effect together with rate, allowed: one of the two");
    }
    for (std::size_t i = 0; i < stage_.moves.size(); ++i)
      if (stage_.moves[i].stiffness) elastic(i, fmt::format("{}.move[{}]", path_, i));
    if (!stage_.until) return;
    until(*stage_.until);
    check_travel(*stage_.until, stage_.moves, stage_.servos, path_ + ".until",
                 [&](const std::string& at, const std::string& message) {
                   problems_.add(origins_.at(at), at, message);
                 });
  }

 private:
  bool given(const std::string& path) const { return origins_.contains(path); }
  void refuse(const std::string& path, const std::string& key, const std::string& message) {
    const std::string at = path + "." + key;
    problems_.add(origins_.at(given(at) ? at : path), at, message);
  }
  const ToolSpec& tool(const ServoSpec& servo) const {
    return scene_.tools[static_cast<std::size_t>(servo.tool)];
  }

  void servo(const ServoSpec& servo, const std::string& path) {
    if (tool(servo).shape == ToolSpec::Shape::constraint)
      return refuse(
          path, "tool",
          fmt::format("'{}' is a constraint, allowed: a plane or a polyline, which have contact",
                      tool(servo).name));
    const Vec3 direction = direction_of(servo, scene_);
    if (direction.isZero(0))
      return refuse(path, "direction",
                    fmt::format("required key is missing: only planes and punches have a normal, "
                                "allowed: {} numbers, not all 0",
                                words_of(scene_).components));
    if (has_face(tool(servo)) && pulls_off(scene_, tool(servo).name, direction, tool(servo).normal))
      refuse(path, "direction", fmt::format(pulled_off, tool(servo).name));
    for (const MoveSpec& move : stage_.moves)
      if (move.tool == servo.tool && !move.stiffness &&
          std::abs(move.displacement.dot(direction)) > 1e-9 * move.displacement.norm())
        refuse(
            path, "tool",
            fmt::format("'{}' is moved along its servo's direction in the same stage, allowed: a "
                        "move across it",
                        tool(servo).name));
  }

  // A move through a spring.
  void elastic(std::size_t number, const std::string& path) {
    const MoveSpec& move = stage_.moves[number];
    const ToolSpec& moved = scene_.tools[static_cast<std::size_t>(move.tool)];
    if (moved.shape == ToolSpec::Shape::constraint)
      refuse(path, "stiffness",
             fmt::format("'{}' is a constraint, allowed: a plane or a polyline", moved.name));
    for (const ServoSpec& servo : stage_.servos)
      if (servo.tool == move.tool)
        refuse(path, "stiffness",
               fmt::format("'{}' has a servo in the same stage, allowed: only one of the two",
                           moved.name));
  }

  void until(const UntilSpec& until) {
    const std::string path = path_ + ".until";
    const int aims = int{until.force.has_value()} + int{until.displacement.has_value()} +
                     int{until.relative_density.has_value()};
    if (aims != 1)
      return refuse(
          path, aims == 0 ? "force" : "relative_density",
          fmt::format("{} of force, displacement and relative_density are given, allowed: "
                      "one",
                      aims));
    if (until.relative_density && until.tool)
      refuse(path, "tool", "has no effect together with relative_density, allowed: without it");
    if (until.relative_density && !scene_.cell && !has_die())
      refuse(path, "relative_density",
             fmt::format("there is no die to which it could refer, allowed: {}",
                         words_of(scene_).dies));
  }

  bool has_die() const { return die_room(scene_).has_value() || die_cell(scene_).has_value(); }

  const Scene& scene_;
  const StageSpec& stage_;
  std::string path_;
  const schema::Origins& origins_;
  Problems& problems_;
};

}  // namespace

Vec3 direction_of(const ServoSpec& servo, const Scene& scene) {
  const ToolSpec& tool = scene.tools[static_cast<std::size_t>(servo.tool)];
  if (servo.direction) return *servo.direction;
  return has_face(tool) ? tool.normal : Vec3::Zero();
}

bool pulls_off(const Scene& scene, const std::string& tool, const Vec3& direction,
               const Vec3& normal) {
  const auto holds = [&](const BondSpec& bond) {
    return bond.first == tool || bond.second == tool;
  };
  return direction.dot(normal) < -1e-9 && std::ranges::none_of(scene.bonds, holds);
}

void check_servos(const Scene& scene, const StageSpec& stage, const std::string& path,
                  const schema::Origins& origins, Problems& problems) {
  ServoChecks(scene, stage, path, origins, problems).run();
}

}  // namespace pulvis
