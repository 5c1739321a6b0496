// Systems of the bodies, by signature. What a system reads and writes is what it declares here; systems/step.cpp puts
// them in order.
// F: the formulation of the elements (components/formulation.hpp).
#pragma once

#include "components/contact.hpp"
#include "components/observed.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "components/surface.hpp"
#include "engine/access.hpp"
#include "engine/look_ahead.hpp"

namespace pulvis {

template <class F>
void elastic_stress(Chunk, Read<Bodies>, Read<Position>, Read<ShearModulus>, Read<BulkModulus>,
                    Write<DeviatoricStress<F::points>>, Write<MeanStress<F::volumes>>,
                    Optional<Write<HourglassStress>>, Optional<Write<LeastCorner>>,
                    Write<LeastJacobian>, Write<WorstElement>);
template <class F>
void trial_stress(Chunk, Read<Bodies>, Read<Position>, Read<ShearModulus>, Read<BulkModulus>,
                  Read<PlasticMetric<F::points>>, Optional<Read<PlasticHourglass>>,
                  Write<IsochoricScale<F::points>>, Write<DeviatoricStress<F::points>>,
                  Write<MeanStress<F::volumes>>, Optional<Write<HourglassStress>>,
                  Optional<Write<LeastCorner>>, Write<LeastJacobian>, Write<WorstElement>);
template <class F>
void j2_return_map(BusyChunk, Read<Bodies>, Read<Position>, Read<ShearModulus>, Read<BulkModulus>,
                   Read<YieldStress>, Read<HardeningModulus>, Read<IsochoricScale<F::points>>,
                   Write<DeviatoricStress<F::points>>, Write<PlasticMetric<F::points>>,
                   Write<PlasticStrain<F::points>>, Optional<Write<HourglassStress>>,
                   Optional<Write<PlasticHourglass>>, Optional<Write<HourglassWork>>);
template <class F>
void internal_force(BusyChunk, Read<Bodies>, Read<Position>, Read<DeviatoricStress<F::points>>,
                    Read<MeanStress<F::volumes>>, Read<ShearModulus>,
                    Optional<Read<HourglassStress>>, Optional<Read<LeastCorner>>,
                    Write<InternalForce>);
template <class F>
void damping_force(Chunk, Read<Bodies>, Read<Clock>, Read<Position>, Read<Velocity>, Read<Density>,
                   Read<ShearModulus>, Read<BulkModulus>, Read<MassDamping>, Read<StiffnessDamping>,
                   Write<DampingForce>, Write<DampingWork>, Write<InternalForce>);
void kinetic_energy(Chunk, Read<Bodies>, Read<Clock>, Read<Density>, Read<InternalForce>,
                    Optional<Read<ContactForce>>, Read<Velocity>, Write<KineticEnergy>);
template <class F>
void elastic_energy(Chunk, Read<Bodies>, Read<Position>, Read<ShearModulus>, Read<BulkModulus>,
                    Optional<Read<PlasticMetric<F::points>>>, Write<ElasticEnergy>);
template <class F>
void plastic_work(Chunk, Read<Bodies>, Read<YieldStress>, Read<HardeningModulus>,
                  Read<PlasticStrain<F::points>>, Optional<Read<HourglassWork>>,
                  Write<PlasticWork>);
void hourglass_energy(Chunk, Read<Bodies>, Read<Position>, Read<ShearModulus>, Read<BulkModulus>,
                      Read<HourglassStress>, Optional<Read<HourglassWork>>, Write<HourglassEnergy>);
template <class F>
void particle_stress(Chunk, Read<Bodies>, Read<Position>, Read<DeviatoricStress<F::points>>,
                     Read<MeanStress<F::volumes>>, Write<ParticleStress>, Write<DeformedArea>,
                     Write<ParticleCentre>);
void integrate(Chunk, Read<Bodies>, Read<Clock>, Read<Density>, Read<InternalForce>,
               Optional<Read<ContactForce>>, Write<Velocity>, Write<Position>);
template <int Points>
void stable_time_step(Chunk, Read<Bodies>, Read<Clock>, Read<Position>, Read<ShearModulus>,
                      Read<BulkModulus>, Read<Density>, Read<DeviatoricStress<Points>>,
                      Optional<Read<ContactRules>>, Optional<Read<MassDamping>>,
                      Optional<Read<StiffnessDamping>>, Optional<Read<ToolServos>>,
                      Write<StableTimeStep>);
void element_health(Read<Bodies>, Read<Clock>, Read<LeastJacobian>, Read<WorstElement>,
                    Write<Totals>);

}  // namespace pulvis
