// A closed contact curve made by hand, for tests of single stages of contact.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "systems/contact/projection.hpp"

namespace pulvis {

// Through these control points, counter-clockwise, and round again; an edge begins at each.
struct ClosedCurve {
  explicit ClosedCurve(const std::vector<Point>& points) {
    const int n = static_cast<int>(points.size());
    Shape shape;
    for (int i = 0; i < n + 3; ++i) {
      const Point& y = entry(points, i % n);
      control.insert(control.end(), y.begin(), y.end());
      shape.curve_begin.push_back(0);
      shape.edge_from.push_back(i % n);
    }
    shape.curve_begin.push_back(0);
    for (int e = 0; e < n; ++e) {
      const Point &a = entry(points, (e + 1) % n), &b = entry(points, (e + 2) % n);
      shape.edges.push_back({.first_control = e,
                             .previous = (e + n - 1) % n,
                             .next = (e + 1) % n,
                             .length = std::hypot(b[0] - a[0], b[1] - a[1]),
                             .ends = {}});
    }
    bodies.shapes = {shape};
    bodies.slots.resize(lane_count);
    for (Bodies::Slot& slot : bodies.slots) slot.number = 0;
  }
  static ClosedCurve circle(double radius, int edges) {
    std::vector<Point> points;
    for (int i = 0; i < edges; ++i) {
      const double angle = 2 * std::numbers::pi * i / edges;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return ClosedCurve(points);
  }

  Shape& shape() { return bodies.shapes[0]; }
  int edges() const { return static_cast<int>(bodies.shapes[0].edges.size()); }

  // Of eight points that look for the curve from the middle of an edge each.
  Projection look_from(const std::array<Point, lane_count>& points,
                       const std::array<int, lane_count>& start) const {
    Projection p;
    p.other = {{0, 0}, {0, 0}, {}, control.data(), nullptr};
    p.points = {Lane::from([&](int l) { return entry(points, l)[0]; }),
                Lane::from([&](int l) { return entry(points, l)[1]; })};
    for (std::size_t l = 0; l < lane_count; ++l) p.at.edge[l] = start[l];
    p.at.u = 0.5;
    p.curve = gather(p.other, control.data(), p.at);
    return p;
  }

  Bodies bodies;
  std::vector<double> control;
};

}  // namespace pulvis
