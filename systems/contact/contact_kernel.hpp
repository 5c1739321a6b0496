// Contact between smooth outlines, integrated along the boundary: curves, closest points, tractions.
//
// Curve    uniform cubic B-spline of control points y (C2). For the edge between knots i and i+1 with
//          parameter u in [0,1]: x(u) = sum_a N_a(u) y_(i-1+a). The y are linear in the boundary nodes,
//          y_i = x_i - c (x_(i-1) - 2 x_i + x_(i+1)), so forces on y map back to x by the transpose and
//          energy and momentum are conserved. A corner ends a spline; see scenes/meshes/contact_curve.
// Contact  the four Gauss points s of an edge of one body against the closest point m of the other's
//          curve: (x_s - x_m) . x_m' = 0, gap g = (x_m - x_s) . n_m [m, > 0 in penetration], pressure
//          p = kappa/2 g (1 + (g/g_s)^2). Then the roles swap: two half passes, no master. The forces are
//          the derivative of sum w kappa/4 g^2 (1 + (g/g_s)^2/2). g_s, a twentieth of the edge, is more
//          than yielding metals reach; the spring stiffens there, so that elastic bodies at large strain
//          and corners do not sink into each other.
// Sign     t = direction of increasing u (counter-clockwise), n = (t_y, -t_x) outward.
#pragma once

#include <array>

#include "engine/lane.hpp"

namespace pulvis::kernels {

// Gauss-Legendre points and weights on [0,1].
inline constexpr double edge_u[4] = {0.069431844202973712388, 0.33000947820757186760,
                                     0.66999052179242813240, 0.93056815579702628761};
inline constexpr double edge_w[4] = {0.17392742256872692869, 0.32607257743127307131,
                                     0.32607257743127307131, 0.17392742256872692869};

template <class T>
constexpr std::array<T, 4> basis(T u) {
  const T v = 1.0 - u, u2 = u * u, v2 = v * v;
  return {v2 * v * (1.0 / 6.0), 0.5 * u2 * u - u2 + 2.0 / 3.0, 0.5 * v2 * v - v2 + 2.0 / 3.0,
          u2 * u * (1.0 / 6.0)};
}
template <class T>
constexpr std::array<T, 4> basis_slope(T u) {
  const T v = 1.0 - u;
  return {-0.5 * (v * v), u * (1.5 * u - 2.0), v * (2.0 - 1.5 * v), 0.5 * (u * u)};
}

// One edge of a curve as a cubic: x(u) = a + u (b + u (c + u d)), for x and y.
template <class T>
struct Cubic {
  T a, b, c, d;
  T value(T u) const { return fma(u, fma(u, fma(u, d, c), b), a); }
  T slope(T u) const { return fma(u, fma(u, 3.0 * d, 2.0 * c), b); }
  T curvature(T u) const { return fma(u, 6.0 * d, 2.0 * c); }
};
template <class T>
[[gnu::always_inline]] inline Cubic<T> cubic(T y0, T y1, T y2, T y3) {
  const T outer = y0 + y2;
  return {fma(1.0 / 6.0, outer, (2.0 / 3.0) * y1), 0.5 * (y2 - y0), fma(0.5, outer, -y1),
          fma(1.0 / 6.0, y3 - y0, 0.5 * (y1 - y2))};
}

// Newton step of the parameter towards the closest point; where the distance is not convex (the far
// side of the outline) the sign of the slope still gives the descent direction.
template <class T>
T closest_point_step(T rx, T ry, T sx, T sy, T cx, T cy) {
  const T slope = fma(rx, sx, ry * sy);  // (x_s - x_m) . x_m'
  const T length2 = fma(sx, sx, sy * sy);
  const T curvature = length2 - fma(rx, cx, ry * cy);
  return slope / max(curvature, 0.25 * length2);
}

}  // namespace pulvis::kernels
