// Systems of the bodies. What a system reads and writes is declared here and nowhere else; systems/step.cpp sets the
// order of the systems, and each is described at the top of its own file.
// D: the dimension (components/dimension.hpp). F: the formulation of the elements (components/formulation.hpp; for systems
// that both dimensions have also components/space/formulation.hpp).
#pragma once

#include <vector>

#include "components/bundles.hpp"
#include "components/highest_mode.hpp"
#include "components/inertance.hpp"
#include "components/observed.hpp"
#include "components/shaped_bodies.hpp"
#include "engine/look_ahead.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {

// ---- stresses and forces ------------------------------------------------------------------------
template <class F>
struct elastic_stress {
  Read<Bodies> bodies;
  Read<Position<TwoD>> position;
  Elasticity elastic;
  ElementStress<Write, F> stress;
  Optional<BendingModes<Write>> bending;
  WorstJacobian<Write> worst;
  void operator()(Chunk chunk) const;
};

template <class F>
struct trial_stress {
  Read<Bodies> bodies;
  Read<Position<TwoD>> position;
  Elasticity elastic;
  struct Plastic {
    Read<CpInverse<TwoD, F::points>> cp_inverse;
    Optional<Read<PlasticHourglass<TwoD>>> hourglass;
    Write<IsochoricScale<F::points>> isochoric;
  } plastic;
  ElementStress<Write, F> stress;
  Optional<BendingModes<Write>> bending;
  WorstJacobian<Write> worst;
  void operator()(Chunk chunk) const;
};

// What sets a material's flow stress: constants of linear hardening, or laws.
struct Flow {
  Read<YieldStress> yield_stress;
  Read<HardeningModulus> hardening;
  Optional<Read<FlowLaws>> laws;
};

template <class F>
struct j2_return_map {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Read<Position<TwoD>> position;
  Elasticity elastic;
  Flow flow;
  struct Points {
    Read<IsochoricScale<F::points>> isochoric;
    Write<DeviatoricStress<TwoD, F::points>> deviator;
    Write<CpInverse<TwoD, F::points>> cp_inverse;
    Write<PlasticStrain<F::points>> strain;
  } points;
  struct Hourglass {  // one-point elements only
    Write<HourglassStress> stress;
    Write<PlasticHourglass<TwoD>> plastic;
    Write<HourglassWork> work;
  };
  Optional<Hourglass> hourglass;
  struct Work {
    Write<WorkBeyondHardening> beyond;
    Optional<Write<ReturnResidual>> residual;  // nonlinear hardening and rate laws only
  } work;
  void operator()(BusyChunk chunk) const;
};

template <class F>
struct internal_force {
  Read<Bodies> bodies;
  Read<Position<TwoD>> position;
  ElementStress<Read, F> stress;
  Read<ShearModulus> shear;
  Optional<BendingModes<Read>> bending;
  Write<InternalForce<TwoD>> force;
  void operator()(BusyChunk chunk) const;
};

template <class F>
struct damping_force {
  ShapedBodies<TwoD> bodies;
  Read<Clock> clock;
  Motion<TwoD> motion;
  Material material;
  BulkDamping constants;
  Write<DampingForce<TwoD>> damping;
  Write<DampingWork> work;
  Write<InternalForce<TwoD>> internal;
  void operator()(Chunk chunk) const;
};

template <class F>
struct surface_hardness {
  using D = typename F::Dimension;
  ShapedBodies<D> bodies;
  struct Settings {
    Read<ContactRules> rules;
    Read<Clock> clock;
  } settings;
  Read<Position<D>> position;
  Read<BulkModulus> bulk;
  Flow flow;
  Read<PlasticStrain<F::points>> strain;
  Write<SurfaceHardness<D>> hardness;
  void operator()(Chunk chunk) const;
};

// ---- motion and stable time steps --------------------------------------------------------------
template <class D>
struct integrate {
  ShapedBodies<D> bodies;
  Read<Clock> clock;
  Read<Density> density;
  NodalForces<Read, D> forces;
  Optional<Read<Inertance>> inertance;
  Write<Velocity<D>> velocity;
  Write<Position<D>> position;
  void operator()(Chunk chunk) const;
};

// Of the elements of a chunk, s: alone, and with contact.
struct StableSteps {
  std::vector<Lane> alone, touching;
};

template <int Points>
struct stable_time_step {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Read<Position<TwoD>> position;
  Material material;
  Read<DeviatoricStress<TwoD, Points>> deviator;
  Optional<Read<ContactRules>> rules;
  Optional<BulkDamping> damping;
  Write<StableTimeStep> stable;
  void operator()(Chunk chunk) const;
  StableSteps of_elements(Chunk chunk) const;  // now, for systems/time_step_limit.hpp
};

template <class F>
struct highest_mode {
  using D = typename F::Dimension;
  ShapedBodies<D> bodies;
  Read<Clock> clock;
  Read<Position<D>> position;
  Material material;
  Read<DeviatoricStress<D, F::points>> deviator;
  struct Springs {
    Read<ContactSupport> support;
    Read<ContactRules> rules;
  };
  Optional<Springs> springs;
  Optional<BulkDamping> damping;
  struct Estimate {
    Optional<Read<Inertance>> inertance;
    Write<HighestMode<D>> mode;
    Write<ModeGain> gain;
    Write<StableTimeStep> stable;
  } estimate;
  void operator()(Chunk chunk) const;
  // Elastic energies of the mode as it is, in a unit of its own: of each element, and last of the contact springs.
  std::vector<Lane> energies(Chunk chunk) const;
};

struct return_health {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Read<ReturnResidual> residual;
  void operator()() const;
};

struct element_health {
  Read<Bodies> bodies;
  Read<Clock> clock;
  WorstJacobian<Read> worst;
  Write<Totals> totals;
  void operator()() const;
};

// ---- sampled steps only ---------------------------------------------------------------------------
template <class D>
struct kinetic_energy {
  ShapedBodies<D> bodies;
  Read<Clock> clock;
  Read<Density> density;
  NodalForces<Read, D> forces;
  Read<Velocity<D>> velocity;
  struct Inerters {
    Read<Inertance> inertance;
    Read<Position<D>> position;
  };
  Optional<Inerters> inerters;
  Write<KineticEnergy> energy;
  void operator()(Chunk chunk) const;
};

template <class F>
struct elastic_energy {
  Read<Bodies> bodies;
  Read<Position<TwoD>> position;
  Elasticity elastic;
  Optional<Read<CpInverse<TwoD, F::points>>> cp_inverse;
  Write<ElasticEnergy> energy;
  void operator()(Chunk chunk) const;
};

template <class F>
struct plastic_work {
  ShapedBodies<typename F::Dimension> bodies;
  Flow flow;
  Read<PlasticStrain<F::points>> eps;
  Optional<Read<HourglassWork>> hourglass;
  Read<WorkBeyondHardening> beyond;
  Write<PlasticWork> work;
  void operator()(Chunk chunk) const;
};

struct hourglass_energy {
  Read<Bodies> bodies;
  Read<Position<TwoD>> position;
  Elasticity elastic;
  Read<HourglassStress> stress;
  Optional<Read<HourglassWork>> spent;
  Write<HourglassEnergy> energy;
  void operator()(Chunk chunk) const;
};

template <class F>
struct particle_stress {
  Read<Bodies> bodies;
  Read<Position<TwoD>> position;
  ElementStress<Read, F> element;
  Write<ParticleStress<TwoD>> stress;
  Write<DeformedSize<TwoD>> size;
  Write<ParticleCentre<TwoD>> centre;
  void operator()(Chunk chunk) const;
};

}  // namespace pulvis
