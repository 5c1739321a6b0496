// Columns of the deformable bodies: nodes, elements (2x2 Gauss points each) and particles.
#pragma once

#include "components/places.hpp"

namespace pulvis {

inline constexpr int gauss_points =
    4;  // of an element, at (xi, eta) = (-,-) (+,-) (+,+) (-,+) / sqrt 3

// ---- nodes ----------------------------------------------------------------------------------
struct Position : Component<Node, double, 2> {
  static constexpr ComponentInfo info{"position", "m", "where the node is at time t_n"};
};
struct Velocity : Component<Node, double, 2> {
  static constexpr ComponentInfo info{"velocity", "m/s", "of the node at t_(n+1/2) (leapfrog)"};
};
struct InternalForce : Component<Node, double, 2> {
  static constexpr ComponentInfo info{"internal_force", "N", "of the stresses, on the node"};
};
struct ContactForce : Component<BoundaryNode, double, 2> {
  static constexpr ComponentInfo info{"contact_force", "N",
                                      "of other particles and tools, on the node"};
};

// ---- elements -------------------------------------------------------------------------------
struct DeviatoricStress : Component<Element, double, 3 * gauss_points> {
  static constexpr ComponentInfo info{"deviatoric_stress", "Pa",
                                      "Cauchy, xx yy xy at each Gauss point; zz = -xx-yy"};
};
struct MeanStress : Component<Element, double, 1> {
  static constexpr ComponentInfo info{"mean_stress", "Pa",
                                      "Cauchy, one for the element; tension > 0"};
};
struct IsochoricScale : Component<Element, double, gauss_points> {
  static constexpr ComponentInfo info{"isochoric_scale", "-",
                                      "(det F)^(-2/3), kept for the return map"};
};
struct PlasticMetric : Component<Element, double, 4 * gauss_points> {
  static constexpr ComponentInfo info{
      "plastic_metric", "-", "inverse plastic right Cauchy-Green tensor less one, xx yy zz xy"};
};
struct PlasticStrain : Component<Element, double, gauss_points> {
  static constexpr ComponentInfo info{"plastic_strain", "-", "accumulated; never decreases"};
};

// ---- particles (lane constants of a chunk, and per-particle results) --------------------------
struct ShearModulus : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"shear_modulus", "Pa", "mu"};
};
struct BulkModulus : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"bulk_modulus", "Pa", "K"};
};
struct Density : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"density", "kg/m^3", "of the undeformed material"};
};
struct YieldStress : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"yield_stress", "Pa",
                                      "initial; infinite for elastic particles"};
};
struct HardeningModulus : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"hardening_modulus", "Pa", "d sigma_y / d eps_p"};
};
struct LeastJacobian : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"least_jacobian", "-",
                                      "smallest det F of the particle this step"};
};
struct WorstElement : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"worst_element", "-",
                                      "number of the element with the least det F"};
};
struct StableTimeStep : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"stable_dt", "s",
                                      "2 / highest frequency bound of its elements"};
};
struct MaximumSpeed : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"maximum_speed", "m/s",
                                      "of the contact curve's control points"};
};
struct KineticEnergy : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"kinetic_energy", "J", "1/2 m v_(n-1/2) v_(n+1/2)"};
};
struct ElasticEnergy : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"elastic_energy", "J", "stored in the elements"};
};
struct PlasticWork : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"plastic_work", "J", "spent in plastic flow so far"};
};
}  // namespace pulvis
