#include "scenes/drawings/chains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/portable_math.hpp"
#include "scenes/language/problem.hpp"

namespace pulvis::drawing {
namespace {

constexpr std::size_t outline_points = 256;
constexpr double meeting = 1e-5;  // of the drawing's diagonal: ends this close are the same point

constexpr double smallest = 1e-12, largest = 1000;  // m, across an outline

double diagonal(const std::vector<Chain>& chains) {
  Vec2 low = Vec2::Constant(1e300), high = -low;
  for (const Chain& chain : chains)
    for (const Vec2& point : chain.points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  return (high - low).norm();
}

// Reverses `chain` if necessary so that it begins at `end`; false if neither of its ends is there.
bool begins_at(Chain& chain, const Vec2& end, double near) {
  if ((chain.points.front() - end).norm() <= near) return true;
  if ((chain.points.back() - end).norm() > near) return false;
  std::ranges::reverse(chain.points);
  return true;
}

void drop_double_end(Chain& chain, double near) {
  if (chain.points.size() > 2 && (chain.points.back() - chain.points.front()).norm() <= near) {
    chain.points.pop_back();
    chain.closed = true;
  }
}

std::string layers_of(const std::vector<const Chain*>& chains) {
  std::set<std::string> names;
  for (const Chain* chain : chains) names.insert("'" + chain->layer + "'");
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<Vec2> evenly(const std::vector<Vec2>& points) {
  const std::size_t count = points.size();
  const auto at = [&](std::size_t i) { return points[i % count]; };
  double length = 0;
  for (std::size_t i = 0; i < count; ++i) length += (at(i + 1) - at(i)).norm();
  const double step = length / static_cast<double>(outline_points);
  std::vector<Vec2> result;
  double before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double side = (at(i + 1) - at(i)).norm();
    while (result.size() < outline_points &&
           static_cast<double>(result.size()) * step < before + side) {
      const double share = (static_cast<double>(result.size()) * step - before) / side;
      result.push_back(at(i) + share * (at(i + 1) - at(i)));
    }
    before += side;
  }
  return result;
}

double side_of(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 along = b - a, to = p - a;
  return along.x() * to.y() - along.y() * to.x();
}

void refuse_size(const Chain& outline, const char* what) {
  const double across = diagonal({outline});
  const bool finite =
      std::ranges::all_of(outline.points, [](const Vec2& point) { return point.allFinite(); });
  if (!finite || !(across >= smallest && across <= largest))
    throw BadDrawing(fmt::format("the {} is {:g} m across, allowed: {:g} m to {:g} m", what, across,
                                 smallest, largest));
}

void refuse_crossing(const std::vector<Vec2>& points) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j + 1 == count) continue;  // neighbours
      const Vec2 &a = points[i], &b = points[i + 1], &c = points[j], &d = points[(j + 1) % count];
      if (side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0)
        throw BadDrawing(
            fmt::format("the outline crosses itself near x = {:g} m, y = {:g} m, "
                        "allowed: one that does not",
                        a.x(), a.y()));
    }
}

}  // namespace

void add_curve(std::vector<Vec2>& points, const std::function<Vec2(double)>& at) {
  for (int i = 1; i <= curve_pieces; ++i)
    points.push_back(at(static_cast<double>(i) / curve_pieces));
}

void add_arc(std::vector<Vec2>& points, const Vec2& centre, double radius, double from,
             double turn) {
  add_curve(points, [&](double share) {
    const double angle = from + share * turn;
    return Vec2(centre + radius * Vec2(portable::cos(angle), portable::sin(angle)));
  });
}

std::vector<Chain> joined(std::vector<Chain> chains) {
  const double near = meeting * diagonal(chains);
  std::erase_if(chains, [](const Chain& chain) { return chain.points.size() < 2; });
  std::vector<Chain> result;
  while (!chains.empty()) {
    Chain whole = std::move(chains.back());
    chains.pop_back();
    drop_double_end(whole, near);
    for (bool grown = true; grown && !whole.closed;) {
      const auto next = std::ranges::find_if(chains, [&](Chain& other) {
        return !other.closed && other.layer == whole.layer &&
               begins_at(other, whole.points.back(), near);
      });
      grown = next != chains.end();
      if (!grown) break;
      whole.points.insert(whole.points.end(), next->points.begin() + 1, next->points.end());
      chains.erase(next);
      drop_double_end(whole, near);
    }
    result.push_back(std::move(whole));
  }
  return result;
}

std::vector<Vec2> only_outline(const std::vector<Chain>& chains) {
  std::vector<const Chain*> closed, open;
  for (const Chain& chain : chains) (chain.closed ? closed : open).push_back(&chain);
  if (closed.size() > 1)
    throw BadDrawing(
        fmt::format("{} closed outlines (in {}), allowed: one, or select it by the key layer",
                    closed.size(), layers_of(closed)));
  if (closed.empty() && !open.empty()) {
    const auto& points = open.front()->points;
    throw BadDrawing(fmt::format(
        "the outline is open: it starts at ({:g}, {:g}) m and ends at ({:g}, {:g}) m, allowed: a "
        "closed one",
        points.front().x(), points.front().y(), points.back().x(), points.back().y()));
  }
  if (closed.empty()) throw BadDrawing("it contains no outline, allowed: one closed outline");
  if (!open.empty())
    throw BadDrawing(
        fmt::format("open lines besides the outline (in {}), allowed: only the outline, or select "
                    "it by the key layer",
                    layers_of(open)));
  refuse_size(*closed.front(), "outline");
  std::vector<Vec2> points = evenly(closed.front()->points);
  refuse_crossing(points);
  return points;
}

std::vector<Vec2> only_line(const std::vector<Chain>& chains) {
  std::vector<const Chain*> closed, open;
  for (const Chain& chain : chains) (chain.closed ? closed : open).push_back(&chain);
  if (!closed.empty())
    throw BadDrawing(
        fmt::format("a closed outline (in {}), allowed: one open line, the face of the tool",
                    layers_of(closed)));
  if (open.size() > 1)
    throw BadDrawing(
        fmt::format("{} lines whose ends do not meet (in {}), allowed: one open line, or select it "
                    "by the key layer",
                    open.size(), layers_of(open)));
  if (open.empty())
    throw BadDrawing("it contains no line, allowed: one open line, the face of the tool");
  refuse_size(*open.front(), "line");
  const double near = meeting * diagonal(chains);
  std::vector<Vec2> points;
  for (const Vec2& point : open.front()->points)
    if (points.empty() || (point - points.back()).norm() > near) points.push_back(point);
  return points;
}

bool Selection::takes(const std::string& name) {
  if (!name.empty() && std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
  const bool is_meant = !empty() && name == layer_;
  found_ = found_ || is_meant;
  return is_meant;
}

void Selection::require_found() const {
  constexpr std::size_t most = 12;  // names listed, of a drawing with a name for every part
  if (empty() || found_) return;
  const std::vector<std::string> first(
      names_.begin(), names_.begin() + static_cast<std::ptrdiff_t>(std::min(most, names_.size())));
  throw BadDrawing(
      fmt::format("there is no layer '{}'{}, allowed: {}{}", layer_, suggestion(layer_, names_),
                  names_.empty() ? "none, since the drawing has no names" : listed(first),
                  names_.size() > most ? ", ..." : ""));
}

}  // namespace pulvis::drawing
