#include "scenes/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/outline.hpp"
#include "scenes/place.hpp"
#include "scenes/surface.hpp"

namespace pulvis {
namespace {

using Kind = ProfileSpec::Kind;
using std::numbers::pi;

constexpr int chords_of_a_sine = 32;
constexpr double pitches_beyond = 2;  // what the powder can press aside stays on the relief

double depth_of(const ProfileSpec& relief) {
  return relief.depth ? *relief.depth : depth_for(relief, *relief.ra);
}

struct Extent {
  double low, high;  // m
};

// Of the powder along x, and of the way of the tool under it.
Extent powder_extent(const Scene& scene, const std::vector<BodySpec>& bodies) {
  Extent extent{1e300, -1e300};
  for (const BodySpec& body : bodies) {
    const Outline& outline = scene.particles[static_cast<std::size_t>(body.particle)].outline;
    const double size = std::sqrt(outline_area(outline));
    double reach = 0;
    for (const Vec2& corner : outline_polygon(outline, 0.1 * size))
      reach = std::max(reach, 1.1 * corner.norm());
    extent.low = std::min(extent.low, body.position.x() - reach);
    extent.high = std::max(extent.high, body.position.x() + reach);
  }
  return extent;
}

// The tool's own frame goes the other way than the powder in it.
Extent covered(const Scene& scene, int tool, Extent powder) {
  double at = 0, least = 0, most = 0;
  for (const StageSpec& stage : scene.stages)
    for (const MoveSpec& move : stage.moves) {
      if (move.tool != tool) continue;
      at += move.displacement.x();
      least = std::min(least, at);
      most = std::max(most, at);
    }
  return {powder.low - most, powder.high - least};
}

std::vector<Vec2> repeated(const ToolSpec& tool, Extent extent) {
  const ProfileSpec& relief = tool.relief;
  const std::vector<Vec2> pitch = one_pitch(relief);
  const double from = tool.point.x();
  const double first = std::floor((extent.low - from) / relief.pitch) - pitches_beyond;
  const double last = std::ceil((extent.high - from) / relief.pitch) + pitches_beyond;
  std::vector<Vec2> points{tool.point + Vec2((first - 1) * relief.pitch, 0)};  // crests go on, flat
  for (double k = first; k < last; ++k)
    for (const Vec2& corner : pitch)
      points.push_back(tool.point + corner + Vec2(k * relief.pitch, 0));
  points.push_back(tool.point + Vec2(last * relief.pitch, 0));
  points.push_back(tool.point + Vec2((last + 1) * relief.pitch, 0));
  return points;
}

}  // namespace

double depth_for(const ProfileSpec& relief, double ra) {
  if (relief.kind == Kind::sine) return pi * ra;
  if (relief.kind == Kind::trapezoid) return ra / (0.25 + 0.5 * relief.flat_share);
  return 4 * ra;
}

std::vector<Vec2> one_pitch(const ProfileSpec& relief) {
  const double p = relief.pitch, d = depth_of(relief);
  std::vector<Vec2> points;
  if (relief.kind == Kind::triangle) points = {{0, 0}, {p / 2, -d}};
  if (relief.kind == Kind::trapezoid) {
    const double half = relief.flat_share * p / 2;
    points = {{half, 0}, {p / 2 - half, -d}, {p / 2 + half, -d}, {p - half, 0}};
  }
  if (relief.kind == Kind::sine)
    for (int i = 0; i < chords_of_a_sine; ++i) {
      const double x = static_cast<double>(i) / chords_of_a_sine;
      points.push_back({p * x, -0.5 * d * (1 - std::cos(2 * pi * x))});
    }
  return points;
}

namespace {

class ProfileChecks {
 public:
  ProfileChecks(const ToolSpec& tool, std::string path, const schema::Origins& origins,
                Problems& problems)
      : relief_(tool.relief), path_(std::move(path)), origins_(origins), problems_(problems) {}

  void run() {
    const bool flat = relief_.kind == Kind::flat;
    for (const char* key : {"pitch", "depth", "ra"})
      if (flat && given(key)) refuse(key, "a flat surface has none, allowed: without it");
    if (given("flat_share") && relief_.kind != Kind::trapezoid)
      refuse("flat_share", "has no effect, allowed: only with relief = \"trapezoid\"");
    if (flat) return;
    if (!given("pitch")) refuse("pitch", "required key is missing, allowed: a quantity in m");
    if (given("depth") == given("ra"))
      refuse(given("ra") ? "ra" : "depth",
             given("ra") ? "has no effect beside depth, allowed: one of the two"
                         : "required key is missing, allowed: a quantity in m, or ra instead");
  }

 private:
  bool given(const std::string& key) const { return origins_.contains(path_ + "." + key); }
  void refuse(const std::string& key, const std::string& message) {
    const std::string at = path_ + "." + key;
    problems_.add(origins_.at(given(key) ? at : path_), at, message);
  }
  const ProfileSpec& relief_;
  std::string path_;
  const schema::Origins& origins_;
  Problems& problems_;
};

}  // namespace

void check_profile(const ToolSpec& tool, const std::string& path, const schema::Origins& origins,
                   Problems& problems) {
  ProfileChecks(tool, path, origins, problems).run();
}

void make_profiles(Scene& scene, const schema::Origins& origins, Problems& problems) {
  const bool any = std::ranges::any_of(
      scene.tools, [](const ToolSpec& t) { return t.shape == ToolSpec::Shape::profile; });
  if (!any) return;
  const Extent powder = powder_extent(scene, place_bodies(scene));
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    ToolSpec& tool = scene.tools[t];
    if (tool.shape != ToolSpec::Shape::profile) continue;
    const Extent extent = covered(scene, static_cast<int>(t), powder);
    if (tool.relief.kind == Kind::flat)
      tool.points = {{extent.low, tool.point.y()}, {extent.high, tool.point.y()}};
    else
      tool.points = repeated(tool, extent);
    tool.shape = ToolSpec::Shape::polyline;
    const std::string path = fmt::format("tool[{}]", t);
    if (const std::string fault = fault_of_polyline(tool.points, tool.rounding); !fault.empty())
      problems.add(origins.at(path), path + ".rounding", fault);
  }
}

}  // namespace pulvis
