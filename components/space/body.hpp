// Columns of deformable bodies in three dimensions: nodes and elements. Particle columns (moduli, energies, time step)
// are shared with two dimensions (components/body.hpp).
//
// Elements are 8-node hexahedra with one integration point and stabilisation of the twelve hourglass modes, or with
// eight (components/space/formulation.hpp).
#pragma once

#include "components/entities.hpp"

namespace pulvis::space {

// ---- nodes ----------------------------------------------------------------------------------
struct Position : Component<Node, double, 3> {
  static constexpr ComponentInfo info{"position", "m", "where the node is at time t_n"};
};
struct Velocity : Component<Node, double, 3> {
  static constexpr ComponentInfo info{"velocity", "m/s", "of the node at t_(n+1/2) (leapfrog)"};
};
struct InternalForce : Component<Node, double, 3> {
  static constexpr ComponentInfo info{"internal_force", "N", "of the stresses, on the node"};
  static constexpr bool transient = true;
};
struct ContactForce : Component<BoundaryNode, double, 3> {
  static constexpr ComponentInfo info{"contact_force", "N",
                                      "of other particles and tools, on the node"};
};

// ---- only if a material has bulk damping ---------------------------------------------------------
struct DampingForce : Component<Node, double, 3> {
  static constexpr ComponentInfo info{"damping_force", "N",
                                      "of bulk damping, on the node; part of the internal force"};
};

// ---- elements -------------------------------------------------------------------------------
template <int Points>
struct DeviatoricStress : Component<Element, double, 5 * Points> {
  static constexpr ComponentInfo info{"deviatoric_stress", "Pa",
                                      "Cauchy, xx yy xy yz zx at each point; zz = -xx-yy"};
  static constexpr bool transient = true;
};
struct MeanStress : Component<Element, double, 1> {
  static constexpr ComponentInfo info{"mean_stress", "Pa", "Cauchy, of the element; tension > 0"};
  static constexpr bool transient = true;
};
template <int Points>
struct PlasticMetric : Component<Element, double, 6 * Points> {
  static constexpr ComponentInfo info{
      "plastic_metric", "-",
      "inverse plastic right Cauchy-Green tensor less one, xx yy zz xy yz zx"};
};
template <int Points>
struct PlasticStrain : Component<Element, double, Points> {
  static constexpr ComponentInfo info{"plastic_strain", "-", "accumulated; never decreases"};
};

// ---- only for one-point elements -----------------------------------------------------------------
struct PlasticHourglass : Component<Element, double, 12> {
  static constexpr ComponentInfo info{
      "plastic_hourglass", "-",
      "plastic part of the strains of bending, twisting and of xi eta zeta"};
};

}  // namespace pulvis::space
