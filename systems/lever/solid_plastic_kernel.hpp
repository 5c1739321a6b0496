// The hexahedron of systems/lever/solid_kernel.hpp with J2 plasticity.
//
// Source   Green-Lagrange strain split into an elastic and a plastic part, E = E_e + E_p, with the second
//          Piola-Kirchhoff stress S = C E_e: Green & Naghdi (1965). Radial return and consistent tangent:
//          Simo & Hughes (1998), boxes 3.1 and 3.2, on the deviator of S. The incompatible modes make the
//          element's stresses orthogonal to them (Simo & Rifai 1990); with plastic points this takes a few
//          inner Newton steps for every displacement.
// Symbols  theta, theta_bar, n as there; law: isotropic hardening of systems/body/j2_kernel.hpp
// Valid    strains small compared to 1 (S is then the stress in the rotated material), arbitrary rotations
#pragma once

#include "systems/body/j2_kernel.hpp"
#include "systems/lever/solid_kernel.hpp"

namespace pulvis::kernels {

// The committed state of a Gauss point.
struct PlasticMemory {
  Voigt strain = Voigt::Zero();  // E_p, engineering shear
  double accumulated = 0;        // -, equivalent plastic strain
};
using HexMemory = std::array<PlasticMemory, 8>;

struct PlasticMaterial {
  double lambda = 0, mu = 0;  // Pa
  LinearHardening<double> law;
  const HardeningLaw* curve = nullptr;  // used instead of linear hardening
};

struct PlasticStress {
  Voigt stress;
  Voigt6 tangent;  // dS/dE
  PlasticMemory memory;
};

inline Voigt deviator(const Voigt& s) {
  Voigt d = s;
  d.head<3>().array() -= s.head<3>().mean();
  return d;
}

inline double tensor_norm(const Voigt& s) {
  return std::sqrt(s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm());
}

inline double flow_stress_of(const PlasticMaterial& m, double eps) {
  if (m.curve == nullptr) return m.law.flow_stress(eps);
  return std::visit([&](const auto& law) { return law.flow_stress(eps); }, *m.curve);
}

// Plastic strain increment, and the slope of the flow stress at its end. NaN if a curve gives none: the
// increment is then cut, as it is if the modes find no balance.
struct PlasticStep {
  double grown, modulus;
};
inline PlasticStep plastic_step(const PlasticMaterial& m, double norm, double excess, double eps) {
  if (m.curve == nullptr) {
    const double modulus = m.law.modulus(eps);
    return {excess / (3 * m.mu + modulus), modulus};
  }
  return std::visit(
      [&](const auto& law) -> PlasticStep {
        Uncoupled alone;
        const Trial<double> trial{norm * norm, norm * norm, norm, eps, 2 * m.mu};
        const Multiplier<double> found = consistent(true, trial, law, alone);
        const double grown = found.residual == 0 ? sqrt_2_3 * found.dgamma : std::nan("");
        return {grown, law.modulus(eps + grown)};
      },
      *m.curve);
}

// A stress that exceeds the flow stress only by round-off does not flow: a point left on the yield surface by an
// equilibrium responds elastically first in the next increment, and does not overshoot when it unloads.
inline PlasticStress return_map(const Voigt& strain, const PlasticMaterial& m,
                                const Voigt6& elastic, const PlasticMemory& before) {
  PlasticStress p{elastic * (strain - before.strain), elastic, before};
  const Voigt trial = deviator(p.stress);
  const double norm = tensor_norm(trial);
  const double flow_stress = flow_stress_of(m, before.accumulated);
  const double excess = std::sqrt(1.5) * norm - flow_stress;
  if (!(excess > 1e-10 * flow_stress)) return p;
  const PlasticStep returned = plastic_step(m, norm, excess, before.accumulated);
  const double step = returned.grown, slope = 3 * m.mu + returned.modulus;
  const Voigt n = trial / norm;
  const double shrink = 2 * m.mu * std::sqrt(1.5) * step;  // of the deviator's norm
  p.stress -= shrink * n;
  p.memory.accumulated += step;
  Voigt flow = std::sqrt(1.5) * step * n;
  flow.tail<3>() *= 2;
  p.memory.strain += flow;
  const double theta = 1 - shrink / norm, theta_bar = 3 * m.mu / slope - (1 - theta);
  const double bulk = m.lambda + 2.0 / 3 * m.mu;
  p.tangent.setZero();
  p.tangent.topLeftCorner<3, 3>().setConstant(bulk - 2.0 / 3 * m.mu * theta);
  p.tangent.diagonal().head<3>().array() += 2 * m.mu * theta;
  p.tangent.diagonal().tail<3>().setConstant(m.mu * theta);
  p.tangent.noalias() -= (2 * m.mu * theta_bar) * (n * n.transpose());
  return p;
}

// The mode amplitudes for which the stresses do no work on the modes.
struct ModeBalance {
  ModeVector alpha = ModeVector::Zero();
  ModeVector work;  // of the stresses on each mode
  ModeMatrix h;     // its derivative
  std::array<PlasticStress, 8> points;
  bool found = false;
};

inline void evaluate_modes(const std::array<HexPoint, 8>& points, const PlasticMaterial& m,
                           const Voigt6& elastic, HexFormulation formulation,
                           const HexMemory& before, ModeBalance& b) {
  b.work.setZero();
  b.h = Hex::no_modes_yet(formulation);
  for (std::size_t g = 0; g < 8; ++g) {
    const HexPoint& p = points[g];
    b.points[g] = return_map(p.strain + p.modes * b.alpha, m, elastic, before[g]);
    const Eigen::Matrix<double, 9, 6> pushed = p.volume * p.modes.transpose();
    b.work.noalias() += pushed.lazyProduct(b.points[g].stress);
    b.h.noalias() += pushed.lazyProduct(b.points[g].tangent).lazyProduct(p.modes);
  }
}

// If no point yields further the balance is linear: Newton's method starts from that solution. Returns the size
// of the terms of the work, which sets its round-off.
inline double elastic_modes(const std::array<HexPoint, 8>& points, const Voigt6& elastic,
                            HexFormulation formulation, const HexMemory& before, ModeBalance& b) {
  ModeMatrix h = Hex::no_modes_yet(formulation);
  ModeVector work = ModeVector::Zero();
  double size = 0;
  for (std::size_t g = 0; g < 8; ++g) {
    const HexPoint& p = points[g];
    const Eigen::Matrix<double, 9, 6> mc = p.volume * p.modes.transpose().lazyProduct(elastic);
    h.noalias() += mc.lazyProduct(p.modes);
    work.noalias() += mc.lazyProduct(p.strain - before[g].strain);
    size += mc.norm() * (p.strain.norm() + before[g].strain.norm());
  }
  b.alpha = -h.llt().solve(work);
  return size;
}

// The work is the derivative of a convex function of the amplitudes: a step that overshoots its minimum is
// halved.
inline ModeBalance balance_modes(const std::array<HexPoint, 8>& points, const PlasticMaterial& m,
                                 const Voigt6& elastic, HexFormulation formulation,
                                 const HexMemory& before) {
  constexpr int maximum = 60, halvings = 8;
  constexpr double enough = 1e-14;
  ModeBalance b;
  const double size = elastic_modes(points, elastic, formulation, before, b);
  evaluate_modes(points, m, elastic, formulation, before, b);
  for (int i = 0; i < maximum; ++i) {
    b.found = b.work.norm() <= enough * size;
    if (b.found) return b;
    ModeVector step = -b.h.llt().solve(b.work);
    const double slope = b.work.dot(step);
    b.alpha += step;
    evaluate_modes(points, m, elastic, formulation, before, b);
    for (int k = 0; k < halvings && b.work.dot(step) > -0.5 * slope; ++k) {
      step *= 0.5;
      b.alpha -= step;
      evaluate_modes(points, m, elastic, formulation, before, b);
    }
  }
  return b;
}

// The response, and the state that the points would commit at this displacement. If the modes find no
// balance the force is NaN: the increment is then cut.
inline HexResponse plastic_response(const Corners& X, const Corners& u, const PlasticMaterial& m,
                                    HexFormulation formulation, const HexMemory& before,
                                    bool with_tangent, HexMemory* after = nullptr) {
  const auto shear = ThinShear::of(X, u, formulation);
  const Voigt6 elastic = Hex::elasticity(m.lambda, m.mu);
  const std::array<HexPoint, 8> points = Hex::points_of(X, u, formulation, shear);
  const ModeBalance b = balance_modes(points, m, elastic, formulation, before);
  HexResponse r;
  r.min_determinant = Hex::min_volume(points);
  if (!b.found) r.force.setConstant(std::nan(""));
  ModeCoupling coupling = ModeCoupling::Zero();
  GeometricMatrix geometric = GeometricMatrix::Zero();
  for (std::size_t g = 0; g < 8; ++g) {
    const HexPoint& p = points[g];
    const PlasticStress& s = b.points[g];
    const Voigt elastic_strain = p.strain + p.modes * b.alpha - s.memory.strain;
    r.energy += 0.5 * p.volume * elastic_strain.dot(s.stress);
    const Voigt pushed = p.pushed(s.stress);
    r.force.noalias() += p.b.transpose().lazyProduct(pushed);
    if (with_tangent) {
      const Hex::StrainRows derivative = p.strain_derivative();
      Hex::add_tangent(p, s.tangent, derivative, r.tangent);
      Hex::add_geometric(p, pushed, shear, geometric);
      coupling.noalias() +=
          p.volume * p.modes.transpose().lazyProduct(s.tangent).lazyProduct(derivative);
    }
    if (after != nullptr) (*after)[g] = s.memory;
  }
  if (with_tangent) Hex::finish_tangent(coupling, b.h.llt(), geometric, r.tangent);
  return r;
}

}  // namespace pulvis::kernels
