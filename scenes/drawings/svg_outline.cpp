#include "scenes/drawings/svg_outline.hpp"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "engine/portable_math.hpp"
#include "scenes/language/units.hpp"

namespace pulvis::drawing {
namespace {

// Reads numbers and letters of attributes: "M0,0l3-4.5e1".
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool ended() {
    skip();
    return rest_.empty();
  }
  char letter() {  // 0: none at this position
    skip();
    const char c = rest_.empty() ? '\0' : rest_.front();
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (is_letter) rest_.remove_prefix(1);
    return is_letter ? c : '\0';
  }
  bool take(char c) {
    skip();
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  double number() {
    skip();
    if (rest_.starts_with('+')) rest_.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc() || !std::isfinite(value))
      throw BadDrawing(fmt::format("'{}' where a number is expected", rest_.substr(0, 20)));
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }
  bool flag() {  // arc flag: needs no blank after it
    skip();
    if (rest_.empty() || (rest_.front() != '0' && rest_.front() != '1'))
      throw BadDrawing("a flag of an arc that is neither 0 nor 1");
    const bool set = rest_.front() == '1';
    rest_.remove_prefix(1);
    return set;
  }
  Vec2 point() {
    const double x = number();
    return {x, number()};
  }
  std::string_view rest() {
    skip();
    return rest_;
  }

 private:
  void skip() {
    while (!rest_.empty() &&
           std::string_view(" \t\r\n,").find(rest_.front()) != std::string_view::npos)
      rest_.remove_prefix(1);
  }
  std::string_view rest_;
};

// x -> a x + offset, as in transform="...".
struct Map {
  std::array<double, 6> m{1, 0, 0, 1, 0, 0};
  Vec2 operator()(const Vec2& p) const {
    return {m[0] * p.x() + m[2] * p.y() + m[4], m[1] * p.x() + m[3] * p.y() + m[5]};
  }
  Map after(const Map& first) const {
    const Vec2 x = (*this)({first.m[0], first.m[1]}), y = (*this)({first.m[2], first.m[3]});
    const Vec2 offset = (*this)({first.m[4], first.m[5]});
    return {{x.x() - m[4], x.y() - m[5], y.x() - m[4], y.y() - m[5], offset.x(), offset.y()}};
  }
};

Map map_called(const std::string& name, const std::vector<double>& given) {
  const auto value = [&](std::size_t i, double otherwise) {
    return i < given.size() ? given[i] : otherwise;
  };
  if (name == "translate") return {{1, 0, 0, 1, value(0, 0), value(1, 0)}};
  if (name == "scale") return {{value(0, 1), 0, 0, value(1, value(0, 1)), 0, 0}};
  if (name == "matrix" && given.size() == 6)
    return {{given[0], given[1], given[2], given[3], given[4], given[5]}};
  if (name == "rotate") {
    const double angle = value(0, 0) * std::numbers::pi / 180;
    const double c = portable::cos(angle), s = portable::sin(angle);
    const Vec2 centre(value(1, 0), value(2, 0));
    return {{c, s, -s, c, centre.x() - c * centre.x() + s * centre.y(),
             centre.y() - s * centre.x() - c * centre.y()}};
  }
  throw BadDrawing(
      fmt::format("the transform '{}', allowed: translate, scale, rotate, matrix", name));
}

Map map_of(const char* transform) {
  Map map;
  Scanner scanner(transform);
  while (!scanner.ended()) {
    std::string name;
    while (const char c = scanner.letter()) name += c;
    if (!scanner.take('(')) throw BadDrawing("a transform without a bracket");
    std::vector<double> given;
    while (!scanner.take(')')) given.push_back(scanner.number());
    map = map.after(map_called(name, given));
  }
  return map;
}

struct Arc {
  Vec2 radii;
  double turned = 0;  // rad
  bool large = false, sweep = false;
};

// Endpoints to centre: SVG 1.1, appendix F.6.
void add_elliptic(std::vector<Vec2>& points, const Arc& arc, const Vec2& end) {
  const Vec2 start = points.back();
  Vec2 r = arc.radii.cwiseAbs();
  if (r.x() == 0 || r.y() == 0 || start == end) {
    points.push_back(end);
    return;
  }
  const double c = portable::cos(arc.turned), s = portable::sin(arc.turned);
  const auto back = [&](const Vec2& p) {
    return Vec2(c * p.x() + s * p.y(), -s * p.x() + c * p.y());
  };
  const auto forth = [&](const Vec2& p) {
    return Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y());
  };
  const Vec2 half = back(0.5 * (start - end));
  const double reach = half.cwiseQuotient(r).squaredNorm();
  if (reach > 1) r *= std::sqrt(reach);
  const double rest = r.x() * r.x() * half.y() * half.y() + r.y() * r.y() * half.x() * half.x();
  const double root = std::sqrt(std::max(0.0, r.x() * r.x() * r.y() * r.y() / rest - 1));
  const Vec2 centre = (arc.large == arc.sweep ? -root : root) *
                      Vec2(r.x() * half.y() / r.y(), -r.y() * half.x() / r.x());
  const auto angle_of = [&](const Vec2& p) {
    return portable::atan2((p.y() - centre.y()) / r.y(), (p.x() - centre.x()) / r.x());
  };
  const double from = angle_of(half);
  double turn = angle_of(-half) - from;
  if (arc.sweep && turn < 0) turn += 2 * std::numbers::pi;
  if (!arc.sweep && turn > 0) turn -= 2 * std::numbers::pi;
  const Vec2 middle = 0.5 * (start + end);
  add_curve(points, [&](double share) {
    const double angle = from + share * turn;
    const Vec2 on(r.x() * portable::cos(angle), r.y() * portable::sin(angle));
    return Vec2(forth(centre + on) + middle);
  });
  points.back() = end;
}

// Reads the chains of a path's d attribute.
class PathReader {
 public:
  explicit PathReader(const char* d) : scanner_(d) {}

  std::vector<Chain> read() {
    char command = '\0';
    while (!scanner_.ended()) {
      if (const char next = scanner_.letter())
        command = next;
      else if (command == 'M' || command == 'm')
        command = command == 'M' ? 'L' : 'l';
      else if (command == '\0' || command == 'Z' || command == 'z')
        throw BadDrawing("a path that does not start with a command");
      step(command);
    }
    finish(false);
    return std::move(chains_);
  }

 private:
  Vec2 here() const { return points_.empty() ? start_ : points_.back(); }
  Vec2 point(bool relative) { return scanner_.point() + (relative ? here() : Vec2(Vec2::Zero())); }

  void finish(bool closed) {
    if (points_.size() > 1) chains_.push_back({points_, closed, {}});
    points_.clear();
  }

  void step(char command) {
    const bool relative = command >= 'a';
    const char kind = relative ? static_cast<char>(command - 'a' + 'A') : command;
    if (kind == 'M') {
      const Vec2 to = point(relative);
      finish(false);
      points_ = {to};
      start_ = to;
      return;
    }
    if (kind == 'Z') {
      finish(true);
      return;
    }
    if (points_.empty()) points_ = {start_};
    Vec2 handle = here();
    if (kind == 'L')
      points_.push_back(point(relative));
    else if (kind == 'H')
      points_.push_back({scanner_.number() + (relative ? here().x() : 0), here().y()});
    else if (kind == 'V')
      points_.push_back({here().x(), scanner_.number() + (relative ? here().y() : 0)});
    else if (kind == 'C' || kind == 'S')
      handle = cubic(kind, relative);
    else if (kind == 'Q' || kind == 'T')
      handle = quadratic(kind, relative);
    else if (kind == 'A')
      arc(relative);
    else
      throw BadDrawing(fmt::format("the command '{}' in a path", command));
    last_ = kind;
    handle_ = kind == 'C' || kind == 'S' || kind == 'Q' || kind == 'T' ? handle : here();
  }

  Vec2 mirrored(char one, char other) const {
    return last_ == one || last_ == other ? Vec2(2 * here() - handle_) : here();
  }

  Vec2 cubic(char kind, bool relative) {
    const Vec2 a = here(), b = kind == 'C' ? point(relative) : mirrored('C', 'S');
    const Vec2 c = point(relative), d = point(relative);
    add_curve(points_, [&](double t) {
      const double u = 1 - t;
      return Vec2(u * u * u * a + 3 * u * u * t * b + 3 * u * t * t * c + t * t * t * d);
    });
    return c;
  }

  Vec2 quadratic(char kind, bool relative) {
    const Vec2 a = here(), b = kind == 'Q' ? point(relative) : mirrored('Q', 'T');
    const Vec2 c = point(relative);
    add_curve(points_, [&](double t) {
      const double u = 1 - t;
      return Vec2(u * u * a + 2 * u * t * b + t * t * c);
    });
    return b;
  }

  void arc(bool relative) {
    Arc arc;
    arc.radii = scanner_.point();
    arc.turned = scanner_.number() * std::numbers::pi / 180;
    arc.large = scanner_.flag();
    arc.sweep = scanner_.flag();
    const Vec2 end = point(relative);
    add_elliptic(points_, arc, end);
  }

  Scanner scanner_;
  std::vector<Chain> chains_;
  std::vector<Vec2> points_;
  Vec2 start_ = Vec2::Zero(), handle_ = Vec2::Zero();
  char last_ = '\0';
};

Chain ellipse_of(const pugi::xml_node& node, double rx, double ry) {
  const Vec2 centre(node.attribute("cx").as_double(), node.attribute("cy").as_double());
  Chain chain{{centre + Vec2(rx, 0)}, false, {}};
  for (int quarter = 0; quarter < 4; ++quarter)
    add_curve(chain.points, [&](double share) {
      const double angle = 0.5 * std::numbers::pi * (quarter + share);
      return Vec2(centre + Vec2(rx * portable::cos(angle), ry * portable::sin(angle)));
    });
  chain.points.pop_back();
  chain.closed = true;
  return chain;
}

Chain corners_of(const pugi::xml_node& node, bool closed) {
  Chain chain{{}, closed, {}};
  Scanner scanner(node.attribute("points").value());
  while (!scanner.ended()) chain.points.push_back(scanner.point());
  return chain;
}

Chain rectangle_of(const pugi::xml_node& node) {
  if (node.attribute("rx") || node.attribute("ry"))
    throw BadDrawing("a rectangle with rounded corners, allowed: sharp corners, or a path");
  const Vec2 low(node.attribute("x").as_double(), node.attribute("y").as_double());
  const Vec2 size(node.attribute("width").as_double(), node.attribute("height").as_double());
  return {{low, low + Vec2(size.x(), 0), low + size, low + Vec2(0, size.y())}, true, {}};
}

std::vector<Chain> shape_of(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  if (name == "path") return PathReader(node.attribute("d").value()).read();
  if (name == "polygon" || name == "polyline") return {corners_of(node, name == "polygon")};
  if (name == "rect") return {rectangle_of(node)};
  if (name == "circle") {
    const double r = node.attribute("r").as_double();
    return {ellipse_of(node, r, r)};
  }
  if (name == "ellipse")
    return {ellipse_of(node, node.attribute("rx").as_double(), node.attribute("ry").as_double())};
  return {};
}

std::string called(const pugi::xml_node& node) {
  const pugi::xml_attribute label = node.attribute("inkscape:label");
  return label ? label.value() : node.attribute("id").value();
}

bool is_selected(const pugi::xml_node& node, Selection& selection) {
  constexpr std::array<std::string_view, 7> drawn{"g",    "path",   "polygon", "polyline",
                                                  "rect", "circle", "ellipse"};
  if (std::ranges::find(drawn, std::string_view(node.name())) == drawn.end()) return false;
  const bool by_label = selection.takes(node.attribute("inkscape:label").value());
  return selection.takes(node.attribute("id").value()) || by_label;
}

// Collects what is drawn, not what is only defined for reuse. The nesting depth is limited to protect the stack.
class Collector {
 public:
  explicit Collector(const std::string& layer) : selection_(layer) {}

  std::vector<Chain> chains_in(const pugi::xml_node& svg, const Map& map) {
    collect(svg, map, "", {0, selection_.empty()});
    selection_.require_found();
    return joined(std::move(chains_));
  }

 private:
  struct Place {
    int depth;
    bool is_meant;
  };

  void collect(const pugi::xml_node& parent, const Map& map, const std::string& layer,
               Place place) {
    if (place.depth > 64) throw BadDrawing("groups nested too deeply, allowed: 64");
    for (const pugi::xml_node& node : parent.children()) {
      const std::string_view kind = node.name();
      const bool is_meant = is_selected(node, selection_) || place.is_meant;
      if (!is_meant && kind != "g") continue;  // whatever it contains
      const Map own = map.after(map_of(node.attribute("transform").value()));
      const std::string name = called(node).empty() ? layer : called(node);
      if (kind == "g") collect(node, own, name, {place.depth + 1, is_meant});
      if (is_meant) add(node, own, selection_.empty() ? name : selection_.layer());
    }
  }

  void add(const pugi::xml_node& node, const Map& map, const std::string& layer) {
    for (Chain& chain : shape_of(node)) {
      for (Vec2& point : chain.points) point = map(point);
      chain.layer = layer;
      chains_.push_back(std::move(chain));
    }
  }

  Selection selection_;
  std::vector<Chain> chains_;
};

// Metres per unit length of the drawing: its width with a unit, "40mm", divided by that of its viewBox.
double scale_of(const pugi::xml_node& svg, const std::string& unit) {
  Scanner width(svg.attribute("width").value());
  std::optional<double> size;
  if (!width.ended()) size = width.number();
  const std::string own(size ? width.rest() : "");
  const bool physical = !own.empty() && own != "px" && own != "%" && own != "em";
  if (physical && !unit.empty())
    throw BadDrawing(fmt::format("its width already has the unit {}, allowed: no key unit", own));
  if (!physical && unit.empty())
    throw BadDrawing(
        "no unit, allowed: a width such as \"40mm\" in its first element, or the key unit");
  try {
    if (!physical) return parse_quantity("1 " + unit, "m");
    const double metres = parse_quantity(fmt::format("{} {}", *size, own), "m");
    Scanner box(svg.attribute("viewBox").value());
    if (box.ended())
      throw BadDrawing("no viewBox, allowed: a viewBox that gives the scale of the width");
    box.point();
    const double extent = box.number();
    if (!(extent > 0)) throw BadDrawing("a viewBox without a width");
    return metres / extent;
  } catch (const UnitError& error) {
    throw BadDrawing(fmt::format("unit: {}, allowed: a length, \"um\"", error.what()));
  }
}

}  // namespace

std::vector<Chain> chains_of_svg(const std::string& text, const std::string& unit,
                                 const std::string& layer) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  const pugi::xml_node svg = document.child("svg");
  if (!parsed)
    throw BadDrawing(
        fmt::format("not an SVG file: {} at byte {}", parsed.description(), parsed.offset));
  if (!svg) throw BadDrawing("not an SVG file: its root element is a different one, allowed: svg");
  const double scale = scale_of(svg, unit);
  return Collector(layer).chains_in(svg, Map{{scale, 0, 0, -scale, 0, 0}});  // y points down in SVG
}

}  // namespace pulvis::drawing
