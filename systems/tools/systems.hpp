// Systems of the tools, by signature. What a system reads and writes is what it declares here; systems/step.cpp puts
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

void tool_motion(Read<Clock>, Read<ToolProgram>, Optional<Read<ServoVelocity>>,
                 Optional<Write<ServoTravel>>, Write<ToolPosition>, Write<ToolVelocity>);
void stage_control(Read<ToolPosition>, Read<ToolForce>, Write<StageEnds>, Write<ToolProgram>,
                   Write<Clock>);
void tool_servo(Read<Clock>, Read<ToolProgram>, Read<ToolForce>, Read<ContactPair<ToolContact>>,
                Read<ContactTouches<ToolContact>>, Read<ContactLaw<ToolContact>>,
                Read<PointForce<ToolContact>>, Write<ToolServos>, Write<ServoMass>,
                Write<ServoVelocity>, Write<ServoDragged>, Write<ServoForce>);
void tool_contact(SmallTasks, Read<Bodies>, Read<Clock>, Read<CurvePosition>,
                  Optional<Read<CurveVelocity>>, Read<ToolPosition>, Read<ToolVelocity>,
                  Read<ToolNormal>, Read<ContactPair<ToolContact>>,
                  Write<ContactTouches<ToolContact>>, Write<ContactReach<ToolContact>>,
                  Read<ContactLaw<ToolContact>>, Write<PointForce<ToolContact>>,
                  Optional<Write<ElasticSlip<ToolContact>>>,
                  Optional<Read<FrictionMore<ToolContact>>>,
                  Optional<Write<StaticLost<ToolContact>>>, Optional<Read<ToolShapes>>,
                  Optional<Read<SurfaceRange>>, Write<ContactSums<ToolContact>>);
void tool_reaction(Read<Clock>, Optional<Read<ContactPair<ToolContact>>>,
                   Optional<Read<ContactTouches<ToolContact>>>,
                   Optional<Read<PointForce<ToolContact>>>, Optional<Read<GripTarget>>,
                   Optional<Read<GripTravel>>, Optional<Read<GripReaction>>, Read<ToolVelocity>,
                   Write<ToolForce>, Write<Totals>);
void ridge_health(Read<Bodies>, Read<Clock>, Read<ContactRules>, Read<ContactIndex>,
                  Read<CurvePosition>, Read<ToolPosition>, Read<ToolShapes>, Read<ToolProgram>,
                  Read<ContactPair<ToolContact>>, Read<ContactTouches<ToolContact>>,
                  Read<SurfaceRange>);
void hold_grips(Chunk, Read<Bodies>, Read<Clock>, Read<ToolProgram>, Read<GripIndex>,
                Read<GripTarget>, Read<GripDirection>, Read<GripTravel>, Read<GripOrigin>,
                Read<Density>, Read<Position>, Read<Velocity>, Optional<Read<ContactForce>>,
                Write<InternalForce>, Write<GripReaction>);
// Where the programme puts a tool at `time`, m. Used outside the step, too.
Point tool_position_at(const ToolProgram& program, int tool, double time);
void first_time_step(Read<StableTimeStep>, Optional<Read<MaximumSpeed>>,
                     Optional<Read<ToolProgram>>, Optional<Read<ServoVelocity>>,
                     Optional<Read<ContactRules>>, Write<Clock>);  // once, at the start
void advance_clock(Read<StableTimeStep>, Optional<Read<MaximumSpeed>>, Optional<Read<ToolProgram>>,
                   Optional<Read<ServoVelocity>>, Read<Totals>, Optional<Read<ContactRules>>,
                   Write<Clock>);

}  // namespace pulvis
