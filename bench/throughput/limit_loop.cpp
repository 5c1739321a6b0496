#include "bench/throughput/limit_loop.hpp"

#include <immintrin.h>

namespace pulvis::bench {
namespace {

// Passed from the first pass to the second. Diagonals of the quad: xab = x_a - x_b.
struct Trial {
  Four y24, y31, x42, x13, hx, hy, over;  // over: 1 / twice the area
  Four dxx, dyy, sxy, mean, mises2;       // trial stress
};

struct Gradient {
  Four xx, xy, yx, yy;
};

[[gnu::always_inline]] inline Trial map_of(const LimitNode* n, const LimitQuad& q) {
  const LimitNode &a = n[q.node[0]], &b = n[q.node[1]], &c = n[q.node[2]], &d = n[q.node[3]];
  Trial t;
  t.y24 = b.y - d.y, t.y31 = c.y - a.y, t.x42 = d.x - b.x, t.x13 = a.x - c.x;
  t.hx = (a.x - b.x) + (c.x - d.x), t.hy = (a.y - b.y) + (c.y - d.y);
  t.over = 1.0 / (t.x13 * t.y24 - t.x42 * t.y31);
  return t;
}

[[gnu::always_inline]] inline Gradient velocity_gradient(const Trial& t, const LimitNode* n,
                                                         const LimitQuad& q) {
  const LimitNode &a = n[q.node[0]], &b = n[q.node[1]], &c = n[q.node[2]], &d = n[q.node[3]];
  const Four u13 = a.u - c.u, u24 = b.u - d.u, v13 = a.v - c.v, v24 = b.v - d.v;
  return {(t.y24 * u13 + t.y31 * u24) * t.over, (t.x42 * u13 + t.x13 * u24) * t.over,
          (t.y24 * v13 + t.y31 * v24) * t.over, (t.x42 * v13 + t.x13 * v24) * t.over};
}

[[gnu::always_inline]] inline void hourglass(const Trial& t, const Gradient& l, const LimitNode* n,
                                             const LimitQuad& q, LimitElement& e,
                                             const LimitMaterial& m) {
  const LimitNode &a = n[q.node[0]], &b = n[q.node[1]], &c = n[q.node[2]], &d = n[q.node[3]];
  const Four hu = (a.u - b.u) + (c.u - d.u), hv = (a.v - b.v) + (c.v - d.v);
  const Four stiffness =
      (t.y24 * t.y24 + t.y31 * t.y31 + (t.x42 * t.x42 + t.x13 * t.x13)) * t.over * m.hourglass;
  e.qx += stiffness * (hu - (l.xx * t.hx + l.xy * t.hy));
  e.qy += stiffness * (hv - (l.yx * t.hx + l.yy * t.hy));
}

// Rotated stress and its elastic increment.
[[gnu::always_inline]] inline void trial_stress(Trial& t, const Gradient& l, const LimitElement& e,
                                                const LimitMaterial& m) {
  const Four twice_spin = m.dt * (l.xy - l.yx), turn = twice_spin * e.sxy;
  const Four volume = (m.lambda * m.dt) * (l.xx + l.yy);
  const double shear = m.two_mu * m.dt;
  const Four sxx = e.sxx + turn + (volume + shear * l.xx);
  const Four syy = e.syy - turn + (volume + shear * l.yy);
  t.sxy = e.sxy + 0.5 * (twice_spin * (e.syy - e.sxx) + shear * (l.xy + l.yx));
  t.mean = (sxx + syy + (e.szz + volume)) * (1.0 / 3.0);
  t.dxx = sxx - t.mean, t.dyy = syy - t.mean;
  t.mises2 = 3.0 * (t.dxx * t.dxx + t.dyy * t.dyy + t.dxx * t.dyy + t.sxy * t.sxy);
}

[[gnu::always_inline]] inline void return_stress(const Trial& t, LimitElement& e,
                                                 const LimitMaterial& m) {
  const Four mises = _mm256_sqrt_pd(t.mises2 + 1e-30);
  const Four excess = mises - (m.yield_stress + m.hardening * e.eps);
  const double three_mu = 1.5 * m.two_mu;
  const Four grown = Four(_mm256_max_pd(excess, Four{})) * (1 / (three_mu + m.hardening));
  const Four kept = 1.0 - (three_mu * grown) / mises;
  e.eps += grown;
  e.sxx = t.mean + t.dxx * kept;
  e.syy = t.mean + t.dyy * kept;
  e.szz = t.mean - (t.dxx + t.dyy) * kept;
  e.sxy = t.sxy * kept;
}

[[gnu::always_inline]] inline void add_forces(const Trial& t, const LimitElement& e,
                                              const LimitQuad& q, LimitForce* f) {
  const Four qx = e.qx * t.over, qy = e.qy * t.over;
  const Four txx = 0.5 * e.sxx - qx * t.hx, txy = 0.5 * e.sxy - qx * t.hy;
  const Four tyx = 0.5 * e.sxy - qy * t.hx, tyy = 0.5 * e.syy - qy * t.hy;
  const Four ax = t.y24 * txx + t.x42 * txy, ay = t.y24 * tyx + t.x42 * tyy;
  const Four bx = t.y31 * txx + t.x13 * txy, by = t.y31 * tyx + t.x13 * tyy;
  f[q.node[0]].x += e.qx + ax, f[q.node[0]].y += e.qy + ay;
  f[q.node[2]].x += e.qx - ax, f[q.node[2]].y += e.qy - ay;
  f[q.node[1]].x += bx - e.qx, f[q.node[1]].y += by - e.qy;
  f[q.node[3]].x -= bx + e.qx, f[q.node[3]].y -= by + e.qy;
}

void move(LimitNode* nodes, LimitForce* force, const LimitMesh& mesh, double dt) {
  for (int i = 0; i < mesh.nodes; ++i) {
    LimitNode& n = nodes[i];
    const double kick = -dt * mesh.inv_mass[i];
    n.u += kick * force[i].x;
    n.v += kick * force[i].y;
    n.x += dt * n.u;
    n.y += dt * n.v;
    force[i] = LimitForce{Four{}, Four{}};
  }
}

}  // namespace

// Ten elements at a time in two passes, so that the division of one and the root of the other do not stall each other.
void limit_step(LimitNode* nodes, LimitElement* elements, LimitForce* force, const LimitMesh& mesh,
                const LimitMaterial& m) {
  constexpr int block = 10;
  Trial trial[block];
  const LimitMaterial local = m;
  for (int first = 0; first < mesh.elements; first += block) {
    const int last = first + block < mesh.elements ? first + block : mesh.elements;
    for (int i = first; i < last; ++i) {
      Trial t = map_of(nodes, mesh.quads[i]);
      const Gradient l = velocity_gradient(t, nodes, mesh.quads[i]);
      hourglass(t, l, nodes, mesh.quads[i], elements[i], local);
      trial_stress(t, l, elements[i], local);
      trial[i - first] = t;
    }
    for (int i = first; i < last; ++i) {
      return_stress(trial[i - first], elements[i], local);
      add_forces(trial[i - first], elements[i], mesh.quads[i], force);
    }
  }
  move(nodes, force, mesh, local.dt);
}

}  // namespace pulvis::bench
