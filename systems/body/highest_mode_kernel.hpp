// Elastic forces of a quad under a small motion v, never softer than the element used in the run.
//
// With H = dv/dx at the centre and h the part of v proportional to xi eta,
//   f = V (C : H) at the middle + V/3 (C : (h g_1^T) g_1 + C : (h g_2^T) g_2) on xi eta,   g = d(xi, eta)/dx
//   C : H = lambda tr(H) 1 + a H + b H^T
// which is the full 2x2 integration of a parallelogram: the bending of every formulation is softer. `corner`
// accounts for other shapes. Moduli per undeformed volume as in time_step_kernel.hpp:
//   lambda = K theta^2 - 2/3 mu,  a = mu + 2 d,  b = mu - K (theta^2 - 1)/2
#pragma once

#include "systems/body/element_kernel.hpp"

namespace pulvis::kernels {

template <class T>
struct TangentModuli {
  T lambda, a, b;  // Pa
};

template <class T>
TangentModuli<T> tangent_moduli(T bulk, T mu, T theta, T distortion) {
  const T theta2 = theta * theta;
  return {bulk * theta2 - (2.0 / 3.0) * mu, mu + 2.3 * (distortion * mu),
          mu - 0.5 * bulk * (theta2 - 1.0)};
}

// (C : (p q^T)) q for vectors p and q: one bending stiffness of the element.
template <class T>
void add_bending(const TangentModuli<T>& c, T px, T py, T qx, T qy, T& fx, T& fy) {
  const T along = (c.lambda + c.b) * (px * qx + py * qy), all = c.a * (qx * qx + qy * qy);
  fx += along * qx + all * px;
  fy += along * qy + all * py;
}

// As moments with xi, eta and xi eta, for unit slice depth: node_forces of them, 1/4 each, are the forces
// that act on the element. v: the map of the nodal motion, analogous to that of the positions.
template <class T>
QuadFlux<T> tangent_flux(const QuadMap<T>& map, const QuadMap<T>& v, const TangentModuli<T>& c,
                         T volume, T corner) {
  const T over = 1.0 / (map.ax * map.by - map.bx * map.ay);
  const T g1x = over * map.by, g1y = -(over * map.bx), g2x = -(over * map.ay), g2y = over * map.ax;
  const T hxx = v.ax * g1x + v.bx * g2x, hxy = v.ax * g1y + v.bx * g2y;
  const T hyx = v.ay * g1x + v.by * g2x, hyy = v.ay * g1y + v.by * g2y;
  const T mean = c.lambda * (hxx + hyy);
  const T sxx = mean + (c.a + c.b) * hxx, syy = mean + (c.a + c.b) * hyy;
  const T sxy = c.a * hxy + c.b * hyx, syx = c.a * hyx + c.b * hxy;
  T hx{}, hy{};
  add_bending(c, v.hx, v.hy, g1x, g1y, hx, hy);
  add_bending(c, v.hx, v.hy, g2x, g2y, hx, hy);
  const T whole = corner * volume, third = (1.0 / 3.0) * whole;
  return {whole * (sxx * g1x + sxy * g1y),
          whole * (syx * g1x + syy * g1y),
          whole * (sxx * g2x + sxy * g2y),
          whole * (syx * g2x + syy * g2y),
          third * hx,
          third * hy};
}

}  // namespace pulvis::kernels
