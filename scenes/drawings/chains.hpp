// What drawings are made of: chains of points, sampled finely from lines and curves, and the one closed outline among
// them.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/language/vec2.hpp"

namespace pulvis::drawing {

struct BadDrawing : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Chain {
  std::vector<Vec2> points;
  bool closed = false;
  std::string layer;  // or what else the drawing calls it
};

inline constexpr int curve_pieces = 64;  // of each curved part

// Adds the points of a curve over (0, 1], the first of which is there already.
void add_curve(std::vector<Vec2>& points, const std::function<Vec2(double)>& at);
// From the last point; angles counter-clockwise, rad.
void add_arc(std::vector<Vec2>& points, const Vec2& centre, double radius, double from,
             double turn);

// Chains whose ends meet are one.
std::vector<Chain> joined(std::vector<Chain> chains);

// What of a drawing is meant: all of it, or what a layer or group of one name holds.
class Selection {
 public:
  explicit Selection(std::string layer = {}) : layer_(std::move(layer)) {}

  bool empty() const { return layer_.empty(); }
  const std::string& layer() const { return layer_; }
  // Whether what bears this name is meant; it is remembered as one that there is.
  bool takes(const std::string& name);
  // Refuses a layer that nothing bears; none of the drawing's if nothing has been asked for.
  void require_found() const;

 private:
  std::string layer_;
  std::vector<std::string> names_;
  bool found_ = false;
};

// The one closed outline, as points that are evenly apart along it. Refused are drawings with none or several, and
// outlines that cross themselves.
std::vector<Vec2> only_outline(const std::vector<Chain>& chains);

// The one open line: its corners, and the points of its curves. Refused are drawings with others, and closed ones.
std::vector<Vec2> only_line(const std::vector<Chain>& chains);

}  // namespace pulvis::drawing
