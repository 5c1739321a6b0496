// A DXF file is a list of pairs: a line with a group code, and one with its value. An entity begins with code 0.
#include "scenes/drawings/dxf_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>

#include "engine/portable_math.hpp"
#include "scenes/language/units.hpp"

namespace pulvis::drawing {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct Group {
  int code = 0;
  std::string value;
};

struct Entity {
  std::string kind;
  std::vector<Group> groups;

  std::string text(int code) const {
    const auto found = std::ranges::find(groups, code, &Group::code);
    return found == groups.end() ? "" : found->value;
  }
  double number(int code, double otherwise = 0) const {
    const auto found = std::ranges::find(groups, code, &Group::code);
    return found == groups.end() ? otherwise : number_of(found->value);
  }
  int whole(int code) const { return static_cast<int>(std::clamp(number(code), -1e9, 1e9)); }
  Vec2 point(int code = 10) const { return {number(code), number(code + 10)}; }

  static double number_of(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      throw BadDrawing(fmt::format("'{}' where a number is expected", text.substr(0, 20)));
    return value;
  }
};

std::string trimmed(const std::string& text) {
  const auto from = text.find_first_not_of(" \t\r");
  return from == std::string::npos ? ""
                                   : text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

std::vector<Group> groups_of(const std::string& text) {
  if (text.starts_with("AutoCAD Binary DXF"))
    throw BadDrawing("a binary DXF file, allowed: a text (ASCII) DXF file");
  std::istringstream stream(text);
  std::vector<Group> groups;
  for (std::string code, value; std::getline(stream, code) && std::getline(stream, value);) {
    const std::string digits = trimmed(code);
    Group group{0, trimmed(value)};
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), group.code);
    if (read.ec != std::errc() || read.ptr != digits.data() + digits.size())
      throw BadDrawing(
          fmt::format("not a DXF file: '{}' where a group code is expected", digits.substr(0, 20)));
    groups.push_back(std::move(group));
  }
  return groups;
}

struct Drawing {
  int unit = 0;  // $INSUNITS
  std::vector<Entity> entities;
};

Drawing drawing_of(const std::vector<Group>& groups) {
  Drawing drawing;
  std::string section, variable;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Group& group = groups[i];
    if (group.code == 0 && group.value == "SECTION" && i + 1 < groups.size())
      section = groups[i + 1].value;
    else if (group.code == 0 && group.value == "ENDSEC")
      section.clear();
    else if (section == "HEADER" && group.code == 9)
      variable = group.value;
    else if (section == "HEADER" && variable == "$INSUNITS" && group.code == 70)
      drawing.unit = static_cast<int>(std::clamp(Entity::number_of(group.value), 0.0, 99.0));
    else if (section == "ENTITIES" && group.code == 0)
      drawing.entities.push_back({group.value, {}});
    else if (section == "ENTITIES" && !drawing.entities.empty())
      drawing.entities.back().groups.push_back(group);
  }
  return drawing;
}

double scale_of(int code, const std::string& unit) {
  constexpr std::array<std::pair<int, double>, 9> known{{{1, 0.0254},
                                                         {2, 0.3048},
                                                         {4, 1e-3},
                                                         {5, 1e-2},
                                                         {6, 1},
                                                         {11, 1e-10},
                                                         {12, 1e-9},
                                                         {13, 1e-6},
                                                         {14, 0.1}}};
  const auto* const found = std::ranges::find(known, code, &std::pair<int, double>::first);
  if (found != known.end() && !unit.empty())
    throw BadDrawing("its header already gives the unit, allowed: no key unit");
  if (found != known.end()) return found->second;
  if (unit.empty()) throw BadDrawing("no unit, allowed: $INSUNITS in its header, or the key unit");
  try {
    return parse_quantity("1 " + unit, "m");
  } catch (const UnitError& error) {
    throw BadDrawing(fmt::format("unit: {}, allowed: a length, \"um\"", error.what()));
  }
}

// An arc segment of a polyline: `bulge` is the tangent of a quarter of its angle.
void add_bulge(std::vector<Vec2>& points, const Vec2& end, double bulge) {
  const Vec2 start = points.back(), along = end - start;
  if (bulge == 0 || along.norm() == 0) {
    points.push_back(end);
    return;
  }
  const double turn = 4 * portable::atan(bulge);
  const double apothem = 0.5 * (1 - bulge * bulge) / (2 * bulge);  // of the chord
  const Vec2 centre = start + 0.5 * along + apothem * Vec2(-along.y(), along.x());
  const Vec2 to = start - centre;
  add_arc(points, centre, to.norm(), portable::atan2(to.y(), to.x()), turn);
  points.back() = end;
}

struct Corner {
  Vec2 place = Vec2::Zero();
  double bulge = 0;
};

Chain polyline_of(const Entity& entity) {
  std::vector<Corner> corners;
  for (const Group& group : entity.groups) {
    if (group.code == 10) corners.push_back({{Entity::number_of(group.value), 0}, 0});
    if (corners.empty()) continue;
    if (group.code == 20) corners.back().place.y() = Entity::number_of(group.value);
    if (group.code == 42) corners.back().bulge = Entity::number_of(group.value);
  }
  const bool closed = (entity.whole(70) & 1) != 0;
  Chain chain;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i == 0) chain.points.push_back(corners[0].place);
    if (i + 1 < corners.size() || closed)
      add_bulge(chain.points, corners[(i + 1) % corners.size()].place, corners[i].bulge);
  }
  return chain;
}

Chain arc_of(const Entity& entity) {
  const bool whole = entity.kind == "CIRCLE";
  const double from = entity.number(50) * degree, radius = entity.number(40);
  double turn = whole ? 2 * std::numbers::pi : entity.number(51) * degree - from;
  while (turn <= 0) turn += 2 * std::numbers::pi;
  const double begin = whole ? 0 : from;
  Chain chain;
  const Vec2 centre = entity.point();
  chain.points.push_back(centre + radius * Vec2(portable::cos(begin), portable::sin(begin)));
  for (int part = 0; part < (whole ? 4 : 1); ++part)
    add_arc(chain.points, centre, radius, begin + 0.5 * std::numbers::pi * part,
            whole ? 0.5 * std::numbers::pi : turn);
  return chain;
}

// A B-spline by de Boor's algorithm, with weights.
class Spline {
 public:
  explicit Spline(const Entity& entity) : degree_(entity.whole(71)) {
    for (const Group& group : entity.groups) {
      if (group.code == 40) knots_.push_back(Entity::number_of(group.value));
      if (group.code == 41) weights_.push_back(Entity::number_of(group.value));
      if (group.code == 10) places_.emplace_back(Entity::number_of(group.value), 0);
      if (group.code == 20 && !places_.empty()) places_.back().y() = Entity::number_of(group.value);
    }
    const bool whole = degree_ >= 1 && degree_ <= 10 &&
                       places_.size() > static_cast<std::size_t>(degree_) &&
                       knots_.size() == places_.size() + static_cast<std::size_t>(degree_) + 1 &&
                       std::ranges::is_sorted(knots_);
    if (!whole)
      throw BadDrawing("a spline without control points and knots, allowed: a spline with both");
    weights_.resize(places_.size(), 1);
  }

  Chain chain() const {
    const auto first = static_cast<std::size_t>(degree_), last = places_.size();
    Chain chain;
    chain.points.push_back(at(knots_[first], first));
    for (std::size_t span = first; span < last; ++span) {
      if (knots_[span + 1] <= knots_[span]) continue;
      add_curve(chain.points, [&](double share) {
        return at(knots_[span] + share * (knots_[span + 1] - knots_[span]), span);
      });
    }
    return chain;
  }

 private:
  Vec2 at(double u, std::size_t span) const {
    const auto p = static_cast<std::size_t>(degree_);
    std::vector<Vec2> places;
    std::vector<double> weights;
    for (std::size_t j = 0; j <= p; ++j) {
      weights.push_back(weights_[span - p + j]);
      places.push_back(weights.back() * places_[span - p + j]);
    }
    for (std::size_t r = 1; r <= p; ++r)
      for (std::size_t j = p; j >= r; --j) {
        const double low = knots_[span - p + j], high = knots_[span + 1 + j - r];
        const double share = high > low ? (u - low) / (high - low) : 0;
        places[j] = (1 - share) * places[j - 1] + share * places[j];
        weights[j] = (1 - share) * weights[j - 1] + share * weights[j];
      }
    return places[p] / weights[p];
  }

  int degree_;
  std::vector<double> knots_, weights_;
  std::vector<Vec2> places_;
};

std::optional<Chain> chain_of(const Entity& entity) {
  if (entity.kind == "LINE") return Chain{{entity.point(), entity.point(11)}, false, {}};
  if (entity.kind == "LWPOLYLINE") return polyline_of(entity);
  if (entity.kind == "ARC" || entity.kind == "CIRCLE") return arc_of(entity);
  if (entity.kind == "SPLINE") return Spline(entity).chain();
  for (const char* const drawn : {"POLYLINE", "ELLIPSE", "INSERT"})
    if (entity.kind == drawn)
      throw BadDrawing(fmt::format("a {}, allowed: LINE, ARC, CIRCLE, LWPOLYLINE, SPLINE", drawn));
  return std::nullopt;  // a point, text or dimension
}

}  // namespace

std::vector<Chain> chains_of_dxf(const std::string& text, const std::string& unit,
                                 const std::string& layer) {
  const Drawing drawing = drawing_of(groups_of(text));
  if (drawing.entities.empty()) throw BadDrawing("not a DXF file, or one without entities");
  const double scale = scale_of(drawing.unit, unit);
  std::vector<Chain> chains;
  Selection selection(layer);
  for (const Entity& entity : drawing.entities) {
    if (!selection.takes(entity.text(8)) && !selection.empty()) continue;
    if (std::optional<Chain> chain = chain_of(entity)) {
      for (Vec2& point : chain->points) point *= scale;
      chain->layer = entity.text(8);
      chains.push_back(std::move(*chain));
    }
  }
  selection.require_found();
  return joined(std::move(chains));
}

}  // namespace pulvis::drawing
