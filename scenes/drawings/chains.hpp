// Building blocks of drawings: chains of points, finely sampled from lines and curves, and the single closed outline
// formed by them.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/language/vectors.hpp"

namespace pulvis::drawing {

struct BadDrawing : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Chain {
  std::vector<Vec2> points;
  bool closed = false;
  std::string layer;  // or another name that the drawing gives it
};

inline constexpr int curve_pieces = 64;  // per curved segment

// Adds the points of a curve over (0, 1]; its first point is already there.
void add_curve(std::vector<Vec2>& points, const std::function<Vec2(double)>& at);
// Continues from the last point; angles counter-clockwise, rad.
void add_arc(std::vector<Vec2>& points, const Vec2& centre, double radius, double from,
             double turn);

// Merges chains whose ends meet.
std::vector<Chain> joined(std::vector<Chain> chains);

// Which part of a drawing is selected: all of it, or the layer or group of one name.
class Selection {
 public:
  explicit Selection(std::string layer = {}) : layer_(std::move(layer)) {}

  bool empty() const { return layer_.empty(); }
  const std::string& layer() const { return layer_; }
  // Whether the item of this name is selected; the name is remembered as existing.
  bool takes(const std::string& name);
  // Refuses a layer name that does not occur in the drawing, if one was requested.
  void require_found() const;

 private:
  std::string layer_;
  std::vector<std::string> names_;
  bool found_ = false;
};

// The only closed outline, as points evenly spaced along it. Refuses drawings with none or several, and
// outlines that intersect themselves.
std::vector<Vec2> only_outline(const std::vector<Chain>& chains);

// The only open line: its corners, and the points of its curves. Refuses drawings with others, and closed lines.
std::vector<Vec2> only_line(const std::vector<Chain>& chains);

}  // namespace pulvis::drawing
