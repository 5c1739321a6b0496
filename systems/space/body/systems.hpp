// Systems of the bodies in three dimensions. Each declares here what it reads and writes; the descriptions
// are at the top of the individual files.
// F: the formulation of the elements (components/space/formulation.hpp).
#pragma once

#include "components/space/bundles.hpp"
#include "components/space/formulation.hpp"
#include "components/space/observed.hpp"
#include "engine/look_ahead.hpp"
#include "systems/body/systems.hpp"

namespace pulvis::space {

// ---- stresses and forces, element by element ------------------------------------------------------
template <class F>
struct ForceResults {
  ElementStress<Write, F> stress;
  WorstJacobian<Write> worst;
  Write<InternalForce> force;
};

template <class F>
struct elastic_force {
  Meshes meshes;
  Read<Position> position;
  Elasticity elastic;
  ForceResults<F> results;
  void operator()(BusyChunk chunk) const;
};

template <class F>
struct PlasticState {
  Write<PlasticMetric<F::points>> metric;
  Write<PlasticStrain<F::points>> strain;
  Optional<Write<PlasticHourglass>> hourglass;  // for one-point elements
};

template <class F>
struct plastic_force {
  Meshes meshes;
  Read<Clock> clock;
  Read<Position> position;
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
  Meshes meshes;
  Read<Clock> clock;
  Motion motion;
  Material material;
  BulkDamping constants;
  Write<DampingForce> damping;
  Write<DampingWork> work;
  Write<InternalForce> internal;
  void operator()(Chunk chunk) const;
};

// ---- motion, and the stable time step -----------------------------------------------------------
struct integrate {
  Meshes meshes;
  Read<Clock> clock;
  Read<Density> density;
  NodalForces<Read> forces;
  Write<Velocity> velocity;
  Write<Position> position;
  void operator()(Chunk chunk) const;
};

template <class F>
struct stable_time_step {
  Meshes meshes;
  Read<Clock> clock;
  Read<Position> position;
  Material material;
  Read<DeviatoricStress<F::points>> deviator;
  Optional<Read<ContactRules>> rules;
  Optional<BulkDamping> damping;
  Write<StableTimeStep> stable;
  void operator()(Chunk chunk) const;
};

// ---- in sampled steps -----------------------------------------------------------------------------
struct kinetic_energy {
  Meshes meshes;
  Read<Clock> clock;
  Read<Density> density;
  NodalForces<Read> forces;
  Read<Velocity> velocity;
  Write<KineticEnergy> energy;
  void operator()(Chunk chunk) const;
};

template <class F>
struct elastic_energy {
  Meshes meshes;
  Read<Position> position;
  Elasticity elastic;
  Optional<Read<PlasticMetric<F::points>>> metric;
  Write<ElasticEnergy> energy;
  void operator()(Chunk chunk) const;
};

template <class F>
struct plastic_work {
  Meshes meshes;
  Flow flow;
  Read<PlasticStrain<F::points>> eps;
  Optional<Read<HourglassWork>> hourglass;
  Read<WorkBeyondHardening> beyond;
  Write<PlasticWork> work;
  void operator()(Chunk chunk) const;
};

struct hourglass_energy {
  Meshes meshes;
  Read<Position> position;
  Elasticity elastic;
  Optional<Read<PlasticHourglass>> plastic;
  Optional<Read<HourglassWork>> spent;
  Write<HourglassEnergy> energy;
  void operator()(Chunk chunk) const;
};

template <class F>
struct particle_stress {
  Meshes meshes;
  Read<Position> position;
  ElementStress<Read, F> element;
  Write<ParticleStress> stress;
  Write<DeformedVolume> volume;
  Write<ParticleCentre> centre;
  void operator()(Chunk chunk) const;
};

}  // namespace pulvis::space
