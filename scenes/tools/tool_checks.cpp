#include "scenes/tools/tool_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "scenes/tools/constraints.hpp"
#include "scenes/tools/profile.hpp"
#include "scenes/tools/servo_checks.hpp"
#include "scenes/tools/surface.hpp"

namespace pulvis {
namespace {

class ToolChecks {
 public:
  ToolChecks(const Scene& scene, const schema::Origins& origins, Problems& problems)
      : scene_(scene), origins_(origins), problems_(problems) {}

  void run() {
    for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
      const std::string path = fmt::format("tool[{}]", t);
      if (!scene_.in_space() || is_constraint(scene_.tools[t])) point(scene_.tools[t], path);
      if (!scene_.in_space()) normal(scene_.tools[t], path);  // in space, its key says all
      if (scene_.tools[t].shape == ToolSpec::Shape::polyline) polyline(scene_.tools[t], path);
      if (scene_.tools[t].shape == ToolSpec::Shape::profile)
        check_profile(scene_.tools[t], path, origins_, problems_);
      if (scene_.tools[t].shape == ToolSpec::Shape::constraint) region(scene_.tools[t], path);
      if (scene_.tools[t].shape == ToolSpec::Shape::punch) profile_of_punch(scene_.tools[t], path);
    }
    for (std::size_t s = 0; s < scene_.stages.size(); ++s) {
      const StageSpec& stage = scene_.stages[s];
      moves(stage.moves, fmt::format("stage[{}]", s));
      check_servos(scene_, stage, fmt::format("stage[{}]", s), origins_, problems_);
    }
    for (std::size_t f = 0; f < scene_.frictions.size(); ++f) friction(scene_.frictions[f], f);
  }

 private:
  bool given(const std::string& path) const { return origins_.contains(path); }

  const char* quantities() const {
    return scene_.in_space() ? "three quantities [x, y, z]" : "two quantities [x, y]";
  }

  void refuse(const std::string& path, const std::string& key, const std::string& message) {
    const std::string at = path + "." + key;
    problems_.add(origins_.at(given(at) ? at : path), at, message);
  }

  void point(const ToolSpec& tool, const std::string& path) {
    const bool plane = tool.shape == ToolSpec::Shape::plane;
    const bool radial =
        tool.shape == ToolSpec::Shape::constraint && tool.holds == ToolSpec::Holds::radial;
    const bool profile = tool.shape == ToolSpec::Shape::profile;
    const bool wanted = plane || profile || radial || tool.radius;
    const bool allowed = wanted || is_drawn(tool, path);
    if (wanted && !given(path + ".point"))
      refuse(path, "point",
             fmt::format("required key is missing: {}, allowed: {} in m",
                         plane     ? "the plane goes through it"
                         : profile ? "a crest stands there"
                         : radial  ? "nodes move radially from it"
                                   : "it is the centre of the radius",
                         quantities()));
    if (!allowed && given(path + ".point"))
      refuse(path, "point",
             scene_.in_space()
                 ? "has no effect on this constraint, allowed: only with holds = \"radial\" or a "
                   "radius"
                 : "has no effect, allowed: only with shape = \"plane\" or \"profile\", with a "
                   "file of "
                   "a polyline, or with shape = \"constraint\" and holds = \"radial\" or a radius");
  }

  bool is_drawn(const ToolSpec& tool, const std::string& path) const {
    return tool.shape == ToolSpec::Shape::polyline && given(path + ".file");
  }

  void normal(const ToolSpec& tool, const std::string& path) {
    const bool drawn = is_drawn(tool, path);
    const bool wanted = drawn || tool.shape == ToolSpec::Shape::plane;
    if (wanted && !given(path + ".normal"))
      refuse(path, "normal",
             fmt::format("required key is missing{}, allowed: two numbers [x, y], not both 0",
                         drawn ? ": it says on which side of the drawn line the powder is" : ""));
    if (!wanted && given(path + ".normal"))
      refuse(path, "normal",
             "has no effect, allowed: only with shape = \"plane\", or with a file of a polyline: "
             "the powder is to the left of its points");
  }

  void polyline(const ToolSpec& tool, const std::string& path) {
    const bool drawn = is_drawn(tool, path);
    if (drawn == given(path + ".points"))
      return refuse(path, drawn ? "file" : "points",
                    drawn ? "has no effect together with points, allowed: one of the two"
                          : "required key is missing, allowed: points in m, or the file of a "
                            "drawing instead");
    if (tool.points.empty()) return;  // its drawing is already rejected
    const char* const key = drawn ? "file" : "points";
    const std::string sharp = fault_of_polyline(tool.points, 0);
    const std::string rounded = fault_of_polyline(tool.points, tool.rounding);
    if (!sharp.empty())
      refuse(path, key, sharp);
    else if (!rounded.empty())
      refuse(path, "rounding", rounded);
  }

  // A constraint defines its nodes in one of two ways.
  void region(const ToolSpec& tool, const std::string& path) {
    for (const char* corner : {"low", "high"}) {
      const bool there = given(path + "." + corner);
      if (tool.radius && there)
        refuse(path, corner,
               "has no effect together with radius, allowed: low and high, or radius alone");
      if (!tool.radius && !there)
        refuse(
            path, corner,
            fmt::format("required key is missing, allowed: {} in m, or radius instead of low and "
                        "high",
                        quantities()));
    }
    const bool box = !tool.radius && given(path + ".low") && given(path + ".high");
    if (!box || (tool.low.array() <= tool.high.array()).all()) return;
    refuse(path, "high",
           fmt::format("the box is empty, allowed: not below and not left of low{}",
                       scene_.in_space() ? ", nor in front of it" : ""));
  }

  // From the axis outward, to the full width of the punch.
  void profile_of_punch(const ToolSpec& tool, const std::string& path) {
    if (tool.profile.empty()) return;
    if (tool.profile.front().x() != 0)
      return refuse(path, "profile",
                    fmt::format("starts {:g} m from the axis, allowed: a first point [\"0 m\", ..]",
                                tool.profile.front().x()));
    for (std::size_t i = 1; i < tool.profile.size(); ++i)
      if (!(tool.profile[i].x() > tool.profile[i - 1].x()))
        return refuse(path, "profile",
                      fmt::format("point {} is not farther from the axis than the one before it, "
                                  "allowed: increasing distances",
                                  i));
    const double end = tool.profile.back().x(), radius = tool.diameter / 2;
    if (std::abs(end - radius) > 1e-9 * radius)
      refuse(path, "profile",
             fmt::format("ends {:g} m from the axis, allowed: at half the diameter, {:g} m", end,
                         radius));
  }

  void moves(const std::vector<MoveSpec>& moves, const std::string& stage) {
    std::set<int> moved;
    for (std::size_t m = 0; m < moves.size(); ++m) {
      const std::string path = fmt::format("{}.move[{}]", stage, m);
      if (!moved.insert(moves[m].tool).second)
        refuse(path, "tool",
               fmt::format("'{}' is moved twice in this stage, allowed: one move for each tool",
                           scene_.tools[static_cast<std::size_t>(moves[m].tool)].name));
      if (moves[m].displacement.isZero(0))
        refuse(path, "displacement",
               "a move by zero has no effect, allowed: a displacement that is not 0");
      move(moves[m], path);
    }
  }

  // A constraint cannot move a node in a direction that it leaves free.
  void move(const MoveSpec& move, const std::string& path) {
    const ToolSpec& tool = scene_.tools[static_cast<std::size_t>(move.tool)];
    if (tool.shape != ToolSpec::Shape::constraint) return;
    const bool radial = tool.holds == ToolSpec::Holds::radial;
    for (int axis = 0; axis < scene_.dimension; ++axis) {
      const bool holds = radial ? axis == 0 : holds_axis(tool.holds, axis);
      if (holds || move.displacement[axis] == 0) continue;
      return refuse(path, "displacement",
                    fmt::format("'{}' does not hold its nodes in {}, allowed: 0 m there{}",
                                tool.name, "xyz"[axis],
                                radial ? ", the radial displacement as the first component" : ""));
    }
  }

  void friction(const FrictionSpec& friction, std::size_t number) {
    for (const ToolSpec& tool : scene_.tools)
      if (tool.shape == ToolSpec::Shape::constraint &&
          (tool.name == friction.first || tool.name == friction.second))
        refuse(fmt::format("friction[{}]", number), "between",
               fmt::format(
                   "the constraint '{}' has no contact, allowed: tools that are not constraints",
                   tool.name));
  }

  const Scene& scene_;
  const schema::Origins& origins_;
  Problems& problems_;
};

}  // namespace

void check_tools(const Scene& scene, const schema::Origins& origins, Problems& problems) {
  ToolChecks(scene, origins, problems).run();
}

}  // namespace pulvis
