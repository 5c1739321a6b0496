#include "scenes/tools/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/tools/profile_file.hpp"
#include "scenes/tools/rough_profile.hpp"
#include "scenes/tools/surface.hpp"

namespace pulvis {
namespace {

using Kind = ProfileSpec::Kind;
using std::numbers::pi;

constexpr int chords_of_a_sine = 32;
constexpr double pitches_beyond = 2;  // margin so that powder pushed aside stays on the relief
constexpr int max_stations = 20'000;
constexpr double upright = 1 - 1e-9;  // x component of a wall's normal

double depth_of(const ProfileSpec& relief) {
  return relief.depth ? *relief.depth : depth_for(relief, *relief.ra);
}

struct Extent {
  double low, high;  // m
};

double farthest_point(const Outline& outline) {
  double farthest = 0;
  for (const Vec2& corner : outline_polygon(outline, 0.1 * std::sqrt(outline_area(outline))))
    farthest = std::max(farthest, corner.norm());
  return farthest;
}

bool is_wall(const ToolSpec& tool) {
  return tool.shape == ToolSpec::Shape::plane && std::abs(tool.normal.x()) >= upright;
}

// Range of a tool's travel along x from its start, over all stages.
Extent travel_of(const Scene& scene, int tool) {
  double at = 0;
  Extent travel{0, 0};
  for (const StageSpec& stage : scene.stages)
    for (const MoveSpec& move : stage.moves) {
      if (move.tool != tool) continue;
      at += move.displacement.x();
      travel.low = std::min(travel.low, at);
      travel.high = std::max(travel.high, at);
    }
  return travel;
}

// Extent of the powder along x.
struct PowderSpan {
  Extent at_rest{1e300, -1e300};  // and as far as it can be pushed aside: to existing walls
  Extent flown{0, 0};             // m, due to its initial velocities
  bool wall_left = false, wall_right = false;  // nothing carries it beyond
};

PowderSpan powder_span(const Scene& scene, const std::vector<BodySpec>& bodies) {
  PowderSpan powder;
  Extent& extent = powder.at_rest;
  double time = 0;
  for (const StageSpec& stage : scene.stages) time += stage.duration;
  std::vector<double> reaches(scene.particles.size(), -1);  // for the classes that have bodies
  for (const BodySpec& body : bodies) {
    const auto particle = static_cast<std::size_t>(body.particle);
    double& reach = reaches[particle];
    if (reach < 0) reach = 1.1 * farthest_point(scene.particles[particle].outline);
    const double flown = body.velocity.x() * time;
    extent.low = std::min(extent.low, body.position.x() - reach);
    extent.high = std::max(extent.high, body.position.x() + reach);
    powder.flown.low = std::min(powder.flown.low, flown);
    powder.flown.high = std::max(powder.flown.high, flown);
  }
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& tool = scene.tools[t];
    if (!is_wall(tool)) continue;
    const Extent travel = travel_of(scene, static_cast<int>(t));
    (tool.normal.x() > 0 ? powder.wall_left : powder.wall_right) = true;
    extent.low = std::min(extent.low, tool.point.x() + travel.low);
    extent.high = std::max(extent.high, tool.point.x() + travel.high);
  }
  return powder;
}

// Where the powder can be: carried by the other tools, in the frame of this tool, so minus its own travel.
Extent covered(const Scene& scene, int tool, const PowderSpan& powder) {
  Extent carried = powder.flown;
  if (powder.wall_left) carried.low = 0;
  if (powder.wall_right) carried.high = 0;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (static_cast<int>(t) == tool || is_wall(scene.tools[t])) continue;
    const Extent travel = travel_of(scene, static_cast<int>(t));
    if (!powder.wall_left) carried.low = std::min(carried.low, travel.low);
    if (!powder.wall_right) carried.high = std::max(carried.high, travel.high);
  }
  const Extent own = travel_of(scene, tool);
  return {powder.at_rest.low + carried.low - own.high,
          powder.at_rest.high + carried.high - own.low};
}

std::vector<Vec2> repeated(const ToolSpec& tool, Extent extent) {
  const ProfileSpec& relief = tool.relief;
  const std::vector<Vec2> pitch = one_pitch(relief);
  const Vec2 at = in_plane(tool.point);
  const double from = at.x();
  const double first = std::floor((extent.low - from) / relief.pitch) - pitches_beyond;
  const double last = std::ceil((extent.high - from) / relief.pitch) + pitches_beyond;
  std::vector<Vec2> points{at + Vec2((first - 1) * relief.pitch, 0)};  // flat extension
  for (double k = first; k < last; ++k)
    for (const Vec2& corner : pitch) points.push_back(at + corner + Vec2(k * relief.pitch, 0));
  points.push_back(at + Vec2(last * relief.pitch, 0));
  points.push_back(at + Vec2((last + 1) * relief.pitch, 0));
  return points;
}

// Crests at the height of the tool's point; beyond the powder the surface goes on at that height.
std::vector<Vec2> between_flats(const std::vector<Vec2>& relief, double height) {
  double top = relief.front().y();
  for (const Vec2& p : relief) top = std::max(top, p.y());
  const double from = relief.front().x(), to = relief.back().x(), length = to - from;
  std::vector<Vec2> points{{from - 2 * length, height}, {from - length, height}};
  for (const Vec2& p : relief) points.push_back({p.x(), p.y() + height - top});
  points.push_back({to + length, height});
  points.push_back({to + 2 * length, height});
  return points;
}

int period_of(double length, double correlation_length) {
  double lengths = lengths_a_period;
  while (lengths * correlation_length < length && lengths * stations_a_length <= max_stations)
    lengths *= 2;
  return static_cast<int>(lengths);
}

// Empty, and rejected, where it would take too many stations.
std::vector<Vec2> rough(const ToolSpec& tool, std::uint64_t seed, Extent extent) {
  const ProfileSpec& relief = tool.relief;
  const double step = relief.correlation_length / stations_a_length;
  const int lengths = period_of(extent.high - extent.low, relief.correlation_length);
  const double first = std::floor((extent.low - tool.point.x()) / step) - stations_a_length;
  const double last = std::ceil((extent.high - tool.point.x()) / step) + stations_a_length;
  if (last - first > max_stations) return {};
  const std::vector<double> heights = rough_heights(*relief.ra, seed, lengths);
  const auto count = static_cast<std::int64_t>(heights.size());
  std::vector<Vec2> points;
  for (auto i = static_cast<std::int64_t>(first); i <= static_cast<std::int64_t>(last); ++i)
    points.push_back({tool.point.x() + static_cast<double>(i) * step,
                      heights[static_cast<std::size_t>((i % count + count) % count)]});
  return between_flats(points, tool.point.y());
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
      points.push_back({p * x, -0.5 * d * (1 - portable::cos(2 * pi * x))});
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
    const bool rough = relief_.kind == Kind::rough, measured = relief_.kind == Kind::file;
    const bool repeats = relief_.kind != Kind::flat && !rough && !measured;
    belongs("pitch", repeats, "\"triangle\", \"sine\" or \"trapezoid\"");
    belongs("depth", repeats, "\"triangle\", \"sine\" or \"trapezoid\"");
    belongs("ra", repeats || rough, "\"triangle\", \"sine\", \"trapezoid\" or \"rough\"");
    belongs("flat_share", relief_.kind == Kind::trapezoid, "\"trapezoid\"");
    belongs("correlation_length", rough, "\"rough\"");
    belongs("file", measured, "\"file\"");
    if (repeats) wanted("pitch", "a quantity in m");
    if (rough) wanted("ra", "a quantity in m");
    if (rough) wanted("correlation_length", "a quantity in m");
    if (measured) wanted("file", "the name of a CSV file");
    if (repeats && given("depth") == given("ra"))
      refuse(given("ra") ? "ra" : "depth",
             given("ra") ? "has no effect together with depth, allowed: one of the two"
                         : "required key is missing, allowed: a quantity in m, or ra instead");
  }

 private:
  bool given(const std::string& key) const { return origins_.contains(path_ + "." + key); }
  void belongs(const char* key, bool does, const char* where) {
    if (given(key) && !does)
      refuse(key, fmt::format("has no effect, allowed: only with relief = {}", where));
  }
  void wanted(const char* key, const char* what) {
    if (!given(key)) refuse(key, fmt::format("required key is missing, allowed: {}", what));
  }
  void refuse(const std::string& key, const std::string& message) {
    const std::string at = path_ + "." + key;
    problems_.add(origins_.at(given(key) ? at : path_), at, message);
  }
  const ProfileSpec& relief_;
  std::string path_;
  const schema::Origins& origins_;
  Problems& problems_;
};

// One tool's polyline, and what is wrong with it.
class ProfileMaker {
 public:
  ProfileMaker(Scene& scene, std::size_t tool, const PowderSpan& powder,
               const schema::Origins& origins, Problems& problems)
      : scene_(scene),
        tool_(scene.tools[tool]),
        extent_(covered(scene, static_cast<int>(tool), powder)),
        path_(fmt::format("tool[{}]", tool)),
        origins_(origins),
        problems_(problems) {}

  void run() {
    const std::vector<Vec2> points = made();
    if (points.empty()) return;  // already rejected
    tool_.points = points;
    tool_.shape = ToolSpec::Shape::polyline;
    if (const std::string fault = fault_of_polyline(points, tool_.rounding); !fault.empty())
      refuse("rounding", fault);
  }

 private:
  std::vector<Vec2> made() {
    if (tool_.relief.kind == Kind::flat) return flat();
    if (tool_.relief.kind == Kind::rough) return made_rough();
    if (tool_.relief.kind == Kind::file) return measured();
    return repeated(tool_, extent_);
  }

  std::vector<Vec2> flat() const {
    return {{extent_.low, tool_.point.y()}, {extent_.high, tool_.point.y()}};
  }

  std::vector<Vec2> made_rough() {
    std::vector<Vec2> points = rough(tool_, scene_.seed, extent_);
    if (points.empty())
      refuse("correlation_length",
             fmt::format(
                 "too short for the {:.6g} m that the powder slides over, allowed: >= {:.6g} m",
                 length(), 1.01 * length() * stations_a_length / max_stations));
    return points;
  }

  std::vector<Vec2> measured() {
    std::vector<Vec2> points = read_profile(scene_.file.parent_path() / tool_.file);
    const double begin = points.front().x();
    for (Vec2& p : points) p.x() += tool_.point.x() - begin;
    const double from = points.front().x(), to = points.back().x();
    if (from <= extent_.low && to >= extent_.high) return between_flats(points, tool_.point.y());
    refuse("file",
           fmt::format("the profile is {:.6g} m long, from x = {:.6g} m to {:.6g} m; powder and "
                       "sliding need it from {:.6g} m to {:.6g} m, allowed: a profile of at least "
                       "{:.6g} m that starts (point) at x <= {:.6g} m",
                       to - from, from, to, extent_.low, extent_.high, length(), extent_.low));
    return {};
  }

  double length() const { return extent_.high - extent_.low; }
  void refuse(const std::string& key, const std::string& message) {
    const std::string at = path_ + "." + key;
    problems_.add(origins_.at(origins_.contains(at) ? at : path_), at, message);
  }

  Scene& scene_;
  ToolSpec& tool_;
  Extent extent_;
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
  const PowderSpan powder = powder_span(scene, place_bodies(scene));
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    if (scene.tools[t].shape == ToolSpec::Shape::profile)
      ProfileMaker(scene, t, powder, origins, problems).run();
}

}  // namespace pulvis
