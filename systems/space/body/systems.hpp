// Systems of the hexahedra. Each declares here what it reads and writes; the descriptions are at the top of the individual
// files. What both dimensions have is in systems/body/systems.hpp.
// F: the formulation of the elements (components/space/formulation.hpp).
#pragma once

#include "components/bundles.hpp"
#include "components/observed.hpp"
#include "components/space/formulation.hpp"
#include "engine/look_ahead.hpp"
#include "systems/body/systems.hpp"

namespace pulvis::space {

// ---- stresses and forces, element by element ------------------------------------------------------
template <class F>
struct ForceResults {
  ElementStress<Write, F> stress;
  WorstJacobian<Write> worst;
  Write<InternalForce<ThreeD>> force;
};

template <class F>
struct elastic_force {
  ShapedBodies<ThreeD> bodies;
  Read<Position<ThreeD>> position;
  Elasticity elastic;
  ForceResults<F> results;
  void operator()(BusyChunk chunk) const;
};

template <class F>
struct PlasticState {
  Write<CpInverse<ThreeD, F::points>> cp_inverse;
  Write<PlasticStrain<F::points>> strain;
  Optional<Write<PlasticHourglass<ThreeD>>> hourglass;  // for one-point elements
};

template <class F>
struct plastic_force {
  ShapedBodies<ThreeD> bodies;
  Read<Clock> clock;
  Read<Position<ThreeD>> position;
  Elasticity elastic;
  Flow flow;
  PlasticState<F> state;
  struct Work {
    Optional<Write<HourglassWork>> hourglass;
    Write<WorkBeyondHardening> beyond;
    Optional<Write<ReturnResidual>> residual;  // for nonlinear hardening and rate dependence
  } work;
  ForceResults<F> results;
  void operator()(BusyChunk chunk) const;
};

template <class F>
struct damping_force {
  ShapedBodies<ThreeD> bodies;
  Read<Clock> clock;
  Motion<ThreeD> motion;
  Material material;
  BulkDamping constants;
  Write<DampingForce<ThreeD>> damping;
  Write<DampingWork> work;
  Write<InternalForce<ThreeD>> internal;
  void operator()(Chunk chunk) const;
};

// ---- the stable time step -----------------------------------------------------------------------
template <class F>
struct stable_time_step {
  ShapedBodies<ThreeD> bodies;
  Read<Clock> clock;
  Read<Position<ThreeD>> position;
  Material material;
  Read<DeviatoricStress<ThreeD, F::points>> deviator;
  Optional<Read<ContactRules>> rules;
  Optional<BulkDamping> damping;
  Write<StableTimeStep> stable;
  void operator()(Chunk chunk) const;
  StableSteps of_elements(Chunk chunk) const;  // now, for systems/time_step_limit.hpp
};

// ---- in sampled steps -----------------------------------------------------------------------------
template <class F>
struct elastic_energy {
  ShapedBodies<ThreeD> bodies;
  Read<Position<ThreeD>> position;
  Elasticity elastic;
  Optional<Read<CpInverse<ThreeD, F::points>>> cp_inverse;
  Write<ElasticEnergy> energy;
  void operator()(Chunk chunk) const;
};

struct hourglass_energy {
  ShapedBodies<ThreeD> bodies;
  Read<Position<ThreeD>> position;
  Elasticity elastic;
  Optional<Read<PlasticHourglass<ThreeD>>> plastic;
  Optional<Read<HourglassWork>> spent;
  Write<HourglassEnergy> energy;
  void operator()(Chunk chunk) const;
};

template <class F>
struct particle_stress {
  ShapedBodies<ThreeD> bodies;
  Read<Position<ThreeD>> position;
  ElementStress<Read, F> element;
  Write<ParticleStress<ThreeD>> stress;
  Write<DeformedSize<ThreeD>> size;
  Write<ParticleCentre<ThreeD>> centre;
  void operator()(Chunk chunk) const;
};

}  // namespace pulvis::space
