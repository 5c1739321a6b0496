// The contact curves of all particles, edge by edge, for observers of contacts on sampled steps.
#pragma once

#include <cmath>
#include <span>

#include "components/shape.hpp"
#include "engine/entry.hpp"
#include "systems/contact/contact_kernel.hpp"

namespace pulvis {

inline double length_of(const Point& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1]); }

inline kernels::Cubic<double> cubic_of(const double* control, int axis) {
  return kernels::cubic(control[axis], control[2 + axis], control[4 + axis], control[6 + axis]);
}

struct Curve {
  kernels::Cubic<double> x, y;
  explicit Curve(const double* control) : x(cubic_of(control, 0)), y(cubic_of(control, 1)) {}
  Point value(double u) const { return {x.value(u), y.value(u)}; }
  Point slope(double u) const { return {x.slope(u), y.slope(u)}; }
  Point normal(double u) const {  // outward
    const Point s = slope(u);
    const double inv_length = 1 / length_of(s);
    return {s[1] * inv_length, -s[0] * inv_length};
  }
};

class Outlines {
 public:
  Outlines(const Bodies& bodies, std::span<const double> control)
      : bodies_(bodies), control_(control) {}
  Curve edge(int slot, int edge) const {
    return from(slot, entry(bodies_.shape_of_slot(slot).edges, edge).first_control);
  }
  // The edge that starts at that control point of the outline.
  Curve from(int slot, int control) const {
    const int first = entry(bodies_.slots, slot).first_control + control;
    return Curve(control_.data() + 2 * static_cast<std::size_t>(first));
  }
  int number(int slot) const { return entry(bodies_.slots, slot).number; }

 private:
  const Bodies& bodies_;
  std::span<const double> control_;
};

}  // namespace pulvis
