// Systems of sampled steps that look at a powder as a whole, by signature. What a system reads and writes is what it declares here; systems/step.cpp puts
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

}  // namespace pulvis
