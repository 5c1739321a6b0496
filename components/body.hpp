// Columns of the deformable bodies: nodes, elements and particles. The formulation of an element sets its points
// (components/formulation.hpp, components/space/formulation.hpp): of a quad, four at (xi, eta) = (-,-) (+,-) (+,+) (-,+) /
// sqrt 3, or one at its centre; of a hexahedron, eight at (+-1, +-1, +-1) / sqrt 3, xi first, or one.
#pragma once

#include "components/dimension.hpp"
#include "components/entities.hpp"
#include "components/formulation.hpp"

namespace pulvis {

// ---- nodes ----------------------------------------------------------------------------------
template <class D>
struct Position : Component<Node, double, D::axes> {
  static constexpr ComponentInfo info{"position", "m", "where the node is at time t_n"};
};
template <class D>
struct Velocity : Component<Node, double, D::axes> {
  static constexpr ComponentInfo info{"velocity", "m/s", "of the node at t_(n+1/2) (leapfrog)"};
};
template <class D>
struct InternalForce : Component<Node, double, D::axes> {
  static constexpr ComponentInfo info{"internal_force", "N", "of the stresses, on the node"};
  static constexpr bool transient = true;
};
template <class D>
struct ContactForce : Component<BoundaryNode, double, D::axes> {
  static constexpr ComponentInfo info{"contact_force", "N",
                                      "of other particles and tools, on the node"};
};

// ---- elements -------------------------------------------------------------------------------
template <class D, int Points>
struct DeviatoricStress : Component<Element, double, (D::axes == 2 ? 3 : 5) * Points> {
  static constexpr ComponentInfo info{"deviatoric_stress", "Pa",
                                      D::axes == 2
                                          ? "Cauchy, xx yy xy at each point; zz = -xx-yy"
                                          : "Cauchy, xx yy xy yz zx at each point; zz = -xx-yy"};
  static constexpr bool transient = true;
};
template <int Volumes>
struct MeanStress : Component<Element, double, Volumes> {
  static constexpr ComponentInfo info{"mean_stress", "Pa",
                                      "Cauchy, one for each dilatation; tension > 0"};
  static constexpr bool transient = true;
};
template <int Points>
struct IsochoricScale : Component<Element, double, Points> {
  static constexpr ComponentInfo info{"isochoric_scale", "-",
                                      "(det F)^(-1/3), kept for the return map"};
  static constexpr bool transient = true;
};
template <class D, int Points>
struct CpInverse : Component<Element, double, (D::axes == 2 ? 4 : 6) * Points> {
  static constexpr ComponentInfo info{
      "cp_inverse", "-",
      D::axes == 2 ? "inverse plastic right Cauchy-Green tensor less one, xx yy zz xy"
                   : "inverse plastic right Cauchy-Green tensor less one, xx yy zz xy yz zx"};
};
template <int Points>
struct PlasticStrain : Component<Element, double, Points> {
  static constexpr ComponentInfo info{"plastic_strain", "-", "accumulated; never decreases"};
};

// ---- only for one-point elements -----------------------------------------------------------------
struct HourglassStress : Component<Element, double, 2> {  // of quads
  static constexpr ComponentInfo info{"hourglass_stress", "Pa",
                                      "of bending: at the edge of the fibres along xi, along eta"};
  static constexpr bool transient = true;
};
template <class D>
struct PlasticHourglass : Component<Element, double, D::axes == 2 ? 2 : 12> {
  static constexpr ComponentInfo info{
      "plastic_hourglass", "-",
      D::axes == 2 ? "plastic bending strain of the fibres along xi, along eta"
                   : "plastic part of the strains of bending, twisting and of xi eta zeta"};
};

// ---- only if a material has bulk damping ---------------------------------------------------------
template <class D>
struct DampingForce : Component<Node, double, D::axes> {
  static constexpr ComponentInfo info{"damping_force", "N",
                                      "of bulk damping, on the node; part of the internal force"};
};
struct MassDamping : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"mass_damping", "1/s", "alpha: force over momentum"};
};
struct StiffnessDamping : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"stiffness_damping", "s",
                                      "beta: viscous stress over the rate of the elastic one"};
};
struct DampingWork : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"damping_work", "J", "spent by bulk damping so far"};
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
  static constexpr ComponentInfo info{"hardening_modulus", "Pa",
                                      "d sigma_y / d eps_p, of linear hardening"};
};
struct MinJacobian : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"min_jacobian", "-",
                                      "smallest det F of the particle this step"};
};
struct MinCorner : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{
      "min_corner", "-", "smallest det F at a Gauss point of its elements over that of the middle"};
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
struct HourglassWork : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"hourglass_work", "J",
                                      "spent in plastic hourglassing so far"};
};
struct WorkBeyondHardening : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"work_beyond_hardening", "J",
                                      "plastic work so far beyond the area under the hardening "
                                      "curve: by the rate of flow, and by the change of volume"};
};
struct ReturnResidual : Component<Particle, double, 2> {
  static constexpr ComponentInfo info{
      "return_residual", "-",
      "of the return that met the flow stress worst: its residual over it, its element"};
};
struct HourglassEnergy : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"hourglass_energy", "J",
                                      "stored in hourglass modes and spent in them so far"};
};
}  // namespace pulvis
