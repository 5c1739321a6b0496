// Bicubic Bezier patches: points, slopes and curvatures, and the Newton step towards the closest point.
//
// Patch    x(u, v) = sum_ij B_i(u) B_j(v) p_(4 j + i), 0 <= u, v <= 1; outward normal x_u cross x_v
// Closest  (x_s - x) . x_u = (x_s - x) . x_v = 0 for r = x_s - x, from the minimum of r.r/2:
//            [x_u.x_u - r.x_uu   x_u.x_v - r.x_uv] [du]   [r.x_u]
//            [      .            x_v.x_v - r.x_vv] [dv] = [r.x_v]
//          If the distance is not convex, the curvatures are dropped (Gauss-Newton), which gives a descent direction.
// Near     Close to the solution the patch is replaced by its second-order Taylor polynomial: a second step on that needs
//          no patch. With steps below `near_step` of a patch the truncation moves the point by 1e-11 of it.
#pragma once

#include <array>

#include "systems/space/contact/vector.hpp"

namespace pulvis::space::kernels {

// Gauss-Legendre points on [0,1].
inline constexpr std::array<double, 4> gauss_at{0.069431844202973712388, 0.33000947820757186760,
                                                0.66999052179242813240, 0.93056815579702628761};

template <class T>
struct Basis {
  std::array<T, 4> value, slope, curvature;
};
template <class T>
[[gnu::always_inline]] constexpr std::array<T, 4> bernstein(const T& u) {
  const T w = 1.0 - u, uw = 3.0 * u * w;
  return {w * w * w, uw * w, uw * u, u * u * u};
}
template <class T>
[[gnu::always_inline]] constexpr std::array<T, 4> bernstein_slope(const T& u) {
  const T w = 1.0 - u, u2 = 3.0 * u * u, w2 = 3.0 * w * w, uw = 6.0 * u * w;
  return {-w2, w2 - uw, uw - u2, u2};
}
template <class T>
[[gnu::always_inline]] inline Basis<T> basis(const T& u) {
  return {
      bernstein(u),
      bernstein_slope(u),
      {6.0 * (1.0 - u), fma(T{} + 18.0, u, T{} - 12.0), fma(T{} - 18.0, u, T{} + 6.0), 6.0 * u}};
}

template <class T>
[[gnu::always_inline]] inline T combined(const std::array<T, 4>& b, const std::array<T, 4>& p) {
  return fma(b[3], p[3], fma(b[2], p[2], fma(b[1], p[1], b[0] * p[0])));
}

template <class T>
struct PatchPoint {
  Vector<T> x, u, v, uu, uv, vv;
};

// Component `k` of all quantities. control(k, p): component k of Bezier point p.
template <class T, class Control>
[[gnu::always_inline]] inline std::array<T, 6> component(const Control& control, int k,
                                                         const Basis<T>& u, const Basis<T>& v) {
  std::array<T, 4> value, slope, curvature;
  for (std::size_t i = 0; i < 4; ++i) {
    const int p = static_cast<int>(i);
    const std::array<T, 4> along{control(k, p), control(k, p + 4), control(k, p + 8),
                                 control(k, p + 12)};
    value[i] = combined(v.value, along);
    slope[i] = combined(v.slope, along);
    curvature[i] = combined(v.curvature, along);
  }
  return {combined(u.value, value),     combined(u.slope, value), combined(u.value, slope),
          combined(u.curvature, value), combined(u.slope, slope), combined(u.value, curvature)};
}

template <class T, class Control>
[[gnu::always_inline]] inline PatchPoint<T> patch_point(const Control& control, const T& u,
                                                        const T& v) {
  const Basis<T> bu = basis(u), bv = basis(v);
  const auto x = component<T>(control, 0, bu, bv), y = component<T>(control, 1, bu, bv),
             z = component<T>(control, 2, bu, bv);
  return {{x[0], y[0], z[0]}, {x[1], y[1], z[1]}, {x[2], y[2], z[2]},
          {x[3], y[3], z[3]}, {x[4], y[4], z[4]}, {x[5], y[5], z[5]}};
}

// Position and slopes only.
template <class T>
struct PatchSlopes {
  Vector<T> x, u, v;
};
template <class T, class Control>
[[gnu::always_inline]] inline PatchSlopes<T> patch_slopes(const Control& control, const T& u,
                                                          const T& v) {
  const std::array<T, 4> bu = bernstein(u), bv = bernstein(v), du = bernstein_slope(u),
                         dv = bernstein_slope(v);
  const auto of = [&](int k) -> std::array<T, 3> {
    std::array<T, 4> value, slope;
    for (std::size_t i = 0; i < 4; ++i) {
      const int p = static_cast<int>(i);
      const std::array<T, 4> along{control(k, p), control(k, p + 4), control(k, p + 8),
                                   control(k, p + 12)};
      value[i] = combined(bv, along);
      slope[i] = combined(dv, along);
    }
    return {combined(bu, value), combined(du, value), combined(bu, slope)};
  };
  const auto x = of(0), y = of(1), z = of(2);
  return {{x[0], y[0], z[0]}, {x[1], y[1], z[1]}, {x[2], y[2], z[2]}};
}

// ---- closest points -----------------------------------------------------------------------------------
inline constexpr double near_step = 5e-4;  // of a patch

// Newton's equations at a point of the patch, solved for any right-hand side.
template <class T>
struct Newton {
  T a, b, c, inv_det;  // [a b; b c]
  T step_u(const T& along_u, const T& along_v) const {
    return (along_u * c - along_v * b) * inv_det;
  }
  T step_v(const T& along_u, const T& along_v) const {
    return (along_v * a - along_u * b) * inv_det;
  }
};

template <class T>
[[gnu::always_inline]] inline Newton<T> newton(const PatchPoint<T>& p, const Vector<T>& r) {
  constexpr double least = 0.1;  // relative to the metric; below this the distance is not convex
  const T a = dot(p.u, p.u), b = dot(p.u, p.v), c = dot(p.v, p.v);
  const T full_a = a - dot(r, p.uu), full_b = b - dot(r, p.uv), full_c = c - dot(r, p.vv);
  const T det = fma(a, c, -(b * b)), full_det = fma(full_a, full_c, -(full_b * full_b));
  const auto convex = (full_a > least * a) & (full_c > least * c) & (full_det > least * det);
  return {select(convex, full_a, a), select(convex, full_b, b), select(convex, full_c, c),
          1.0 / select(convex, full_det, det)};
}

// Taylor expansion of the patch about one of its points.
template <class T>
[[gnu::always_inline]] inline PatchSlopes<T> taylor(const PatchPoint<T>& p, const T& du,
                                                    const T& dv) {
  const Vector<T> u = fma(du, p.uu, dv * p.uv), v = fma(du, p.uv, dv * p.vv);
  return {fma(du, fma(T{} + 0.5, u, p.u), fma(dv, fma(T{} + 0.5, v, p.v), p.x)), p.u + u, p.v + v};
}

}  // namespace pulvis::space::kernels
