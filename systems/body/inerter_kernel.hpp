// Inerters between boundary nodes and the nodes behind them: stiff contact springs then do not shorten the time step.
//
// Law      a pair of opposite forces b d2L/dt2 along the line of two nodes, L their distance: the two-terminal element of
//          Smith (2002). It conserves momentum and angular momentum, adds no mass to rigid motion and has no static
//          effect: it adds inertia to the stretching of the outermost elements alone, which is what a contact spring makes
//          oscillate fastest. Kinetic energy b/2 (dL/dt)^2
// Symbols  nodes 1, 2, 3 from the boundary inwards, inerters between 1 and 2, 2 and 3; of each mu = m1 m2 / (m1 + m2) and
//          c = (b/mu) / (1 + b/mu) < 1. With F the forces on the nodes, w the relative velocity normal to the line and d
//          the unit vector towards the outer node, without inerters d2L/dt2 were r = (F1/m1 - F2/m2) . d + |w|^2/L. The
//          forces f on the outer nodes along d follow from
//            f1/(c mu1) - s f2 = -r1,   f2/(c mu2) - s f1 = -r2,   s = d1 . d2 / m2
//          In a ring each inerter shares both of its nodes with others: four such equations
#pragma once

#include <array>
#include <cstddef>

#include "engine/lane.hpp"

namespace pulvis::kernels {

template <class T, std::size_t Axes>
T dot(const std::array<T, Axes>& a, const std::array<T, Axes>& b) {
  T sum = a[0] * b[0];
  for (std::size_t k = 1; k < Axes; ++k) sum += a[k] * b[k];
  return sum;
}

template <class T>
struct Inerter {
  T length2;  // m^2: L^2
  T c_mu;     // kg
  T bare;     // m^2/s^2: L r + (dL/dt)^2
  T along;    // m^2/s: L dL/dt
};

// x [m], v [m/s], a [m/s^2]: of the outer node relative to the inner one, a without inerters. `c_mu` kg.
template <class T, std::size_t Axes>
Inerter<T> inerter(const std::array<T, Axes>& x, const std::array<T, Axes>& v,
                   const std::array<T, Axes>& a, const T& c_mu) {
  return {dot(x, x), c_mu, dot(x, a) + dot(v, v), dot(x, v)};
}

// f/L, N/m: times x it is the force on the outer node of an inerter, its opposite that on the inner one.
template <class T>
T inerter_force(const Inerter<T>& of) {
  const T over = 1.0 / of.length2;
  return -(of.c_mu * over) * (of.bare - of.along * of.along * over);
}
// Of two that share a node; `coupling` m^2/kg: x1 . x2 / m2. One division for all.
template <class T>
std::array<T, 2> inerter_forces(const Inerter<T>& first, const Inerter<T>& second,
                                const T& coupling) {
  const T both = first.length2 * second.length2, back = coupling * first.c_mu,
          forth = coupling * second.c_mu, rest = both - back * forth, over = 1.0 / (both * rest);
  const T scale = over * both, over_first = over * rest * second.length2,
          over_second = over * rest * first.length2;
  const T one = first.bare - first.along * first.along * over_first,
          two = second.bare - second.along * second.along * over_second;
  return {-(first.c_mu * scale) * (second.length2 * one + forth * two),
          -(second.c_mu * scale) * (first.length2 * two + back * one)};
}

// Of four in a ring; `coupling` m^2/kg: of each node, that of the inerters before and after it.
template <class T>
std::array<T, 4> inerter_ring_forces(const std::array<Inerter<T>, 4>& of,
                                     const std::array<T, 4>& coupling) {
  const auto& s = coupling;
  std::array<T, 4> w, q;  // kg/m^2; m^2/s^2, L r of each
  for (std::size_t i = 0; i < 4; ++i) {
    const T over = 1.0 / of[i].length2;
    w[i] = of[i].c_mu * over;
    q[i] = of[i].bare - of[i].along * of[i].along * over;
  }
  // The first and the third eliminated, which share no node.
  const T q0 = w[0] * q[0], q2 = w[2] * q[2];
  const T a = 1.0 - w[1] * (s[1] * s[1] * w[0] + s[2] * s[2] * w[2]),
          b = 1.0 - w[3] * (s[0] * s[0] * w[0] + s[3] * s[3] * w[2]),
          c = s[0] * s[1] * w[0] + s[2] * s[3] * w[2];
  const T one = w[1] * (q[1] + s[1] * q0 + s[2] * q2),
          three = w[3] * (q[3] + s[0] * q0 + s[3] * q2);
  const T over = -1.0 / (a * b - w[1] * w[3] * c * c);
  const T f1 = over * (b * one + w[1] * c * three), f3 = over * (a * three + w[3] * c * one);
  return {w[0] * (s[1] * f1 + s[0] * f3) - q0, f1, w[2] * (s[2] * f1 + s[3] * f3) - q2, f3};
}

// J; `mu` kg. v: half a step before and after, as for the kinetic energy of nodes (systems/body/energies.cpp).
template <class T, std::size_t Axes>
T inerter_energy(const std::array<T, Axes>& x, const std::array<T, Axes>& before,
                 const std::array<T, Axes>& after, const T& mu, const T& c) {
  return (0.5 * c / (1.0 - c)) * mu * dot(x, before) * dot(x, after) / dot(x, x);
}

}  // namespace pulvis::kernels
