// Every system of the explicit step, by signature. What a system reads and writes is what it declares
// here; systems/step.cpp puts them in order.
#pragma once

#include "components/contact.hpp"
#include "components/observed.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "components/surface.hpp"
#include "engine/access.hpp"
#include "engine/look_ahead.hpp"

namespace pulvis {

// ---- tools and binning ------------------------------------------------------------------------
void tool_motion(Read<Clock>, Read<ToolProgram>, Optional<Read<ServoVelocity>>,
                 Optional<Write<ServoTravel>>, Write<ToolPosition>, Write<ToolVelocity>);
void stage_control(Read<ToolPosition>, Read<ToolForce>, Write<StageEnds>, Write<ToolProgram>,
                   Write<Clock>);
void tool_servo(Read<Clock>, Read<ToolProgram>, Read<ToolForce>, Read<ContactPair<ToolContact>>,
                Read<ContactTouches<ToolContact>>, Read<ContactLaw<ToolContact>>,
                Read<PointForce<ToolContact>>, Write<ToolServos>, Write<ServoMass>,
                Write<ServoVelocity>, Write<ServoDragged>, Write<ServoForce>);
void skin_check(Read<Bodies>, Read<Clock>, Read<CurvePosition>, Optional<Read<ToolPosition>>,
                Optional<Read<ToolNormal>>, Optional<Read<ToolShapes>>, Write<CurveBefore>,
                Write<ContactIndex>);
void bin_edges(Read<Bodies>, Read<ContactRules>, Read<BulkModulus>, Read<Density>,
               Read<CurvePosition>, Write<ContactIndex>, Structural<Contact>,
               Write<ContactPair<Contact>>, Write<ContactLaw<Contact>>,
               Write<ContactReach<Contact>>, Write<ContactPlace>, Write<ClosestPoint>,
               Optional<Write<FrictionMore<Contact>>>);
void bin_tool_edges(Read<Bodies>, Read<ContactRules>, Read<BulkModulus>, Read<Density>,
                    Read<CurvePosition>, Read<ToolPosition>, Read<ToolNormal>, Write<ContactIndex>,
                    Structural<ToolContact>, Write<ContactPair<ToolContact>>,
                    Write<ContactLaw<ToolContact>>, Write<ContactReach<ToolContact>>,
                    Optional<Read<ToolShapes>>, Optional<Write<SurfaceRange>>,
                    Optional<Write<FrictionMore<ToolContact>>>);

// ---- narrow phase -----------------------------------------------------------------------------
void edge_contact(SmallTasks, Read<Bodies>, Read<Clock>, Read<CurvePosition>,
                  Optional<Read<CurveVelocity>>, Write<ClosestPoint>, Read<ContactPair<Contact>>,
                  Read<ContactPlace>, Write<ContactTouches<Contact>>, Write<ContactReach<Contact>>,
                  Read<ContactLaw<Contact>>, Write<PointForce<Contact>>,
                  Optional<Write<ElasticSlip<Contact>>>, Optional<Read<FrictionMore<Contact>>>,
                  Optional<Write<StaticLost<Contact>>>, Optional<Write<FrictionCouple>>,
                  Write<ContactSums<Contact>>);
void tool_contact(SmallTasks, Read<Bodies>, Read<Clock>, Read<CurvePosition>,
                  Optional<Read<CurveVelocity>>, Read<ToolPosition>, Read<ToolVelocity>,
                  Read<ToolNormal>, Read<ContactPair<ToolContact>>,
                  Write<ContactTouches<ToolContact>>, Write<ContactReach<ToolContact>>,
                  Read<ContactLaw<ToolContact>>, Write<PointForce<ToolContact>>,
                  Optional<Write<ElasticSlip<ToolContact>>>,
                  Optional<Read<FrictionMore<ToolContact>>>,
                  Optional<Write<StaticLost<ToolContact>>>, Optional<Read<ToolShapes>>,
                  Optional<Read<SurfaceRange>>, Write<ContactSums<ToolContact>>);
void contact_totals(Read<Clock>, Optional<Read<ContactSums<Contact>>>,
                    Optional<Read<ContactSums<ToolContact>>>, Write<Totals>);
void tool_reaction(Read<Clock>, Optional<Read<ContactPair<ToolContact>>>,
                   Optional<Read<ContactTouches<ToolContact>>>,
                   Optional<Read<PointForce<ToolContact>>>, Optional<Read<GripTarget>>,
                   Optional<Read<GripTravel>>, Optional<Read<GripReaction>>, Read<ToolVelocity>,
                   Write<ToolForce>, Write<Totals>);
void contact_health(Read<Bodies>, Read<Clock>, Read<ContactRules>,
                    Optional<Read<ContactPair<Contact>>>, Optional<Read<ContactSums<Contact>>>,
                    Optional<Read<ContactPair<ToolContact>>>,
                    Optional<Read<ContactSums<ToolContact>>>, Optional<Read<ToolProgram>>,
                    Write<Totals>);
void ridge_health(Read<Bodies>, Read<Clock>, Read<ContactRules>, Read<ContactIndex>,
                  Read<CurvePosition>, Read<ToolPosition>, Read<ToolShapes>, Read<ToolProgram>,
                  Read<ContactPair<ToolContact>>, Read<ContactTouches<ToolContact>>,
                  Read<SurfaceRange>);

// ---- chunk by chunk: forces of the bodies -------------------------------------------------------
void contact_force(Chunk, Read<Bodies>, Read<ContactIndex>, Optional<Read<ContactPlace>>,
                   Optional<Read<ContactTouches<Contact>>>, Optional<Read<PointForce<Contact>>>,
                   Optional<Read<ClosestPoint>>, Optional<Read<FrictionCouple>>,
                   Optional<Read<ContactPair<ToolContact>>>,
                   Optional<Read<ContactTouches<ToolContact>>>,
                   Optional<Read<PointForce<ToolContact>>>, Write<CurveForce>, Write<ContactForce>);
// F: the formulation of the elements (components/formulation.hpp).
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
void hold_grips(Chunk, Read<Bodies>, Read<Clock>, Read<ToolProgram>, Read<GripIndex>,
                Read<GripTarget>, Read<GripDirection>, Read<GripTravel>, Read<GripOrigin>,
                Read<Density>, Read<Position>, Read<Velocity>, Optional<Read<ContactForce>>,
                Write<InternalForce>, Write<GripReaction>);

// ---- on sampled steps ---------------------------------------------------------------------------
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
void contact_network(Read<Bodies>, Read<ContactIndex>, Read<CurvePosition>,
                     Optional<Read<ContactPair<Contact>>>, Optional<Read<ContactTouches<Contact>>>,
                     Optional<Read<PointForce<Contact>>>, Optional<Read<ClosestPoint>>,
                     Optional<Read<ContactPair<ToolContact>>>,
                     Optional<Read<ContactTouches<ToolContact>>>,
                     Optional<Read<PointForce<ToolContact>>>, Optional<Read<ToolPosition>>,
                     Optional<Read<ToolNormal>>, Optional<Read<ToolShapes>>,
                     Optional<Read<SurfaceRange>>, Write<ContactNetwork>);
void contact_quality(Read<Bodies>, Read<ContactIndex>, Read<CurvePosition>,
                     Optional<Read<ContactPair<Contact>>>, Optional<Read<ContactTouches<Contact>>>,
                     Optional<Read<PointForce<Contact>>>, Optional<Read<ClosestPoint>>,
                     Optional<Read<ContactPair<ToolContact>>>,
                     Optional<Read<ContactTouches<ToolContact>>>,
                     Optional<Read<PointForce<ToolContact>>>, Optional<Read<ToolPosition>>,
                     Optional<Read<ToolNormal>>, Optional<Read<ToolShapes>>,
                     Optional<Read<SurfaceRange>>, Write<ContactQuality>);
void force_chains(Read<Bodies>, Read<ParticleStress>, Read<ParticleCentre>, Read<ContactNetwork>,
                  Write<ForceChains>);
void local_density(Read<Bodies>, Read<Position>, Read<ToolPosition>, Write<DensityGrid>);

// ---- motion ---------------------------------------------------------------------------------------
void integrate(Chunk, Read<Bodies>, Read<Clock>, Read<Density>, Read<InternalForce>,
               Optional<Read<ContactForce>>, Write<Velocity>, Write<Position>);
void contact_curve(Chunk, Read<Bodies>, Read<Position>, Read<Velocity>, Write<CurvePosition>,
                   Optional<Write<CurveVelocity>>, Write<MaximumSpeed>);
template <int Points>
void stable_time_step(Chunk, Read<Bodies>, Read<Clock>, Read<Position>, Read<ShearModulus>,
                      Read<BulkModulus>, Read<Density>, Read<DeviatoricStress<Points>>,
                      Optional<Read<ContactRules>>, Optional<Read<MassDamping>>,
                      Optional<Read<StiffnessDamping>>, Optional<Read<ToolServos>>,
                      Write<StableTimeStep>);
void element_health(Read<Bodies>, Read<Clock>, Read<LeastJacobian>, Read<WorstElement>,
                    Write<Totals>);
void first_time_step(Read<StableTimeStep>, Optional<Read<MaximumSpeed>>,
                     Optional<Read<ToolProgram>>, Optional<Read<ServoVelocity>>,
                     Optional<Read<ContactRules>>, Write<Clock>);  // once, at the start
void advance_clock(Read<StableTimeStep>, Optional<Read<MaximumSpeed>>, Optional<Read<ToolProgram>>,
                   Optional<Read<ServoVelocity>>, Read<Totals>, Optional<Read<ContactRules>>,
                   Write<Clock>);

// ---- used outside the step too --------------------------------------------------------------------
// Where the programme puts a tool at `time`, m.
Point tool_position_at(const ToolProgram& program, int tool, double time);
}  // namespace pulvis
