// Systems of surfaces that meet, by signature. What a system reads and writes is what it declares here; systems/step.cpp puts
// them in order.
#pragma once

#include "components/contact.hpp"
#include "components/observed.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "components/surface.hpp"
#include "engine/access.hpp"
#include "engine/look_ahead.hpp"

namespace pulvis {

void skin_check(Read<Bodies>, Read<Clock>, Read<CurvePosition>, Optional<Read<ToolPosition>>,
                Optional<Read<ToolNormal>>, Optional<Read<ToolShapes>>, Write<CurveBefore>,
                Write<ContactIndex>);
void bin_edges(Read<Bodies>, Read<ContactRules>, Read<BulkModulus>, Read<Density>,
               Read<CurvePosition>, Write<ContactIndex>, Structural<Contact>,
               Write<ContactPair<Contact>>, Write<ContactLaw<Contact>>,
               Read<ContactTouches<Contact>>, Write<ContactReach<Contact>>, Write<ContactPlace>,
               Write<ClosestPoint>, Optional<Write<FrictionMore<Contact>>>);
void bin_tool_edges(Read<Bodies>, Read<ContactRules>, Read<BulkModulus>, Read<Density>,
                    Read<CurvePosition>, Read<ToolPosition>, Read<ToolNormal>, Write<ContactIndex>,
                    Structural<ToolContact>, Write<ContactPair<ToolContact>>,
                    Write<ContactLaw<ToolContact>>, Write<ContactReach<ToolContact>>,
                    Optional<Read<ToolShapes>>, Optional<Write<SurfaceRange>>,
                    Optional<Write<FrictionMore<ToolContact>>>);
void edge_contact(SmallTasks, Read<Bodies>, Read<Clock>, Read<CurvePosition>,
                  Optional<Read<CurveVelocity>>, Write<ClosestPoint>, Read<ContactPair<Contact>>,
                  Read<ContactPlace>, Write<ContactTouches<Contact>>, Write<ContactReach<Contact>>,
                  Read<ContactLaw<Contact>>, Write<PointForce<Contact>>,
                  Optional<Write<ElasticSlip<Contact>>>, Optional<Read<FrictionMore<Contact>>>,
                  Optional<Write<StaticLost<Contact>>>, Optional<Write<FrictionCouple>>,
                  Write<ContactSums<Contact>>);
void contact_health(Read<Bodies>, Read<Clock>, Read<ContactRules>,
                    Optional<Read<ContactPair<Contact>>>, Optional<Read<ContactSums<Contact>>>,
                    Optional<Read<ContactPair<ToolContact>>>,
                    Optional<Read<ContactSums<ToolContact>>>, Optional<Read<ToolProgram>>,
                    Write<Totals>);
void contact_force(Chunk, Read<Bodies>, Read<ContactIndex>, Optional<Read<ContactPlace>>,
                   Optional<Read<ContactTouches<Contact>>>, Optional<Read<PointForce<Contact>>>,
                   Optional<Read<ClosestPoint>>, Optional<Read<FrictionCouple>>,
                   Optional<Read<ContactPair<ToolContact>>>,
                   Optional<Read<ContactTouches<ToolContact>>>,
                   Optional<Read<PointForce<ToolContact>>>, Write<CurveForce>, Write<ContactForce>);
void contact_curve(Chunk, Read<Bodies>, Read<Position>, Read<Velocity>, Write<CurvePosition>,
                   Optional<Write<CurveVelocity>>, Write<MaximumSpeed>);
void contact_totals(Read<Clock>, Optional<Read<ContactSums<Contact>>>,
                    Optional<Read<ContactSums<ToolContact>>>, Write<Totals>);

}  // namespace pulvis
