// Systems of the quasi-static solver. What a system reads and writes is declared here and nowhere else;
// systems/lever/static_solver.cpp sets their order, and each is described at the top of its own file.
#pragma once

#include "engine/system.hpp"
#include "systems/laws/flow_law.hpp"
#include "systems/lever/solid_bundles.hpp"
#include "systems/lever/solid_equations.hpp"

namespace pulvis {

// Only if a material of the solid yields. Mode: access to the plastic strains of the last equilibrium.
template <template <class> class Mode>
struct SolidPlasticity {
  Read<SolidYield> yield;
  Optional<Read<FlowLaws>> laws;  // one per part; without them all harden linearly
  Mode<SolidMemory> memory;
};

// ---- elements -------------------------------------------------------------------------------------
struct solid_element {
  Read<SolidMesh> mesh;
  Configuration configuration;
  Read<LameConstants> elastic;
  Optional<SolidPlasticity<Read>> plasticity;
  Write<ElementForce> force;
  Write<ElementTangent> tangent;
  Write<ElementEnergy> energy;
  void operator()(Chunk chunk) const;
};

struct element_force {
  Read<SolidMesh> mesh;
  Configuration configuration;
  Read<LameConstants> elastic;
  Optional<SolidPlasticity<Read>> plasticity;
  Write<ElementForce> force;
  Write<ElementEnergy> energy;
  void operator()(Chunk chunk) const;
};

struct solid_tetrahedron {
  Read<SolidMesh> mesh;
  Configuration configuration;
  Read<TetrahedronLame> elastic;
  Write<TetrahedronForce> force;
  Write<TetrahedronTangent> tangent;
  Write<TetrahedronEnergy> energy;
  void operator()(Chunk chunk) const;
};

struct tetrahedron_force {
  Read<SolidMesh> mesh;
  Configuration configuration;
  Read<TetrahedronLame> elastic;
  Write<TetrahedronForce> force;
  Write<TetrahedronEnergy> energy;
  void operator()(Chunk chunk) const;
};

// ---- equations ------------------------------------------------------------------------------------
struct solid_force {
  Read<SolidAssembly> assembly;
  ElementForces elements;
  Write<SolidForce> force;
  void operator()() const;
};

struct block_tangent {
  Read<SolidAssembly> assembly;
  ElementTangents elements;
  Write<BlockTangent> block;
  void operator()() const;
};

struct residual {
  Read<SolidMesh> mesh;
  ElementForces elements;
  Read<SolidForce> force;
  Read<AppliedForce> applied;
  struct Contact {
    Read<Target> target;
    Read<ProbeNode> node;
    Read<ProbeForce> force;
    Read<ProbeState> state;
  };
  Optional<Contact> contact;
  Write<SolidEquations> equations;
  void operator()() const;
};

struct factorise {
  Read<SolidAssembly> assembly;
  Read<BlockTangent> block;
  Write<SolidEquations> equations;
  void operator()() const;
};

struct factorise_extended {
  Read<SolidAssembly> assembly;
  Read<SolidMesh> mesh;
  Configuration configuration;
  Read<LameConstants> elastic;
  Optional<Read<TetrahedronLame>> tetrahedron;
  Optional<SolidPlasticity<Read>> plasticity;
  Write<SolidEquations> equations;
  void operator()() const;
};

struct newton_direction {
  Write<SolidEquations> equations;
  void operator()() const;
};

// ---- contact --------------------------------------------------------------------------------------
struct probe_contact {
  Configuration configuration;
  Read<Target> target;
  Probe probe;
  Write<ProbeState> state;
  void operator()() const;
};

struct contact_direction {
  Read<SolidMesh> mesh;
  Configuration configuration;
  Read<Target> target;
  Probe probe;
  Read<ProbeState> state;
  Write<SolidEquations> equations;
  void operator()() const;
};

// ---- after an equilibrium -------------------------------------------------------------------------
struct commit_contact {
  Configuration configuration;
  Read<Target> target;
  Read<ProbeNode> node;
  Read<ProbeForce> force;
  Read<ProbeState> state;
  Write<ProbeMemory> memory;
  void operator()() const;
};

struct commit_plasticity {
  Read<SolidMesh> mesh;
  Configuration configuration;
  Read<LameConstants> elastic;
  SolidPlasticity<Write> plasticity;
  void operator()(Chunk chunk) const;
};

}  // namespace pulvis
