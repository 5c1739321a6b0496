// Inerters between boundary nodes and the nodes behind them: stiff contact springs then do not shorten the time step.
//
// Law      a pair of opposite forces b d2L/dt2 along the line of two nodes, L their distance: the two-terminal element of
//          Smith (2002). It conserves momentum and angular momentum, adds no mass to rigid motion and has no static
//          effect: it adds inertia to the stretching of the outermost elements alone, which is what a contact spring makes
//          oscillate fastest. Kinetic energy b/2 (dL/dt)^2
// Symbols  mu = m1 m2 / (m1 + m2), c = (b/mu) / (1 + b/mu) < 1; with w the relative velocity normal to the line and F the
//          forces on the nodes, d2L/dt2 = (a1 - a2) . d + |w|^2/L gives the force on node 1, along the unit vector d from
//          node 2 to 1,
//            f = -c mu [(F1/m1 - F2/m2) . d + |w|^2/L]
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

// N per m of distance: times x it is the force on node 1, its opposite that on node 2. x [m], v [m/s], a [m/s^2]: of
// node 1 relative to node 2, a without the inerter. `c_mu` kg.
template <class T, std::size_t Axes>
T inerter_force(const std::array<T, Axes>& x, const std::array<T, Axes>& v,
                const std::array<T, Axes>& a, const T& c_mu) {
  const T over = 1.0 / dot(x, x), along = dot(x, v);
  const T turning = dot(v, v) - along * along * over;
  return -(c_mu * over) * (dot(x, a) + turning);
}

// J; `mu` kg.
template <class T, std::size_t Axes>
T inerter_energy(const std::array<T, Axes>& x, const std::array<T, Axes>& v, const T& mu,
                 double c) {
  const T along = dot(x, v);
  return (0.5 * c / (1 - c)) * mu * along * along / dot(x, x);
}

// m1 m2 / (m1 + m2)
inline double reduced_mass(double m1, double m2) { return m1 * m2 / (m1 + m2); }

}  // namespace pulvis::kernels
