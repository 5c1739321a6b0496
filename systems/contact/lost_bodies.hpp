// lost_bodies: stops a run in which a particle has gone through a wall; see its source file.
#pragma once

#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/surface.hpp"
#include "engine/access.hpp"

namespace pulvis {

void lost_bodies(Read<Bodies>, Read<Clock>, Read<ToolProgram>, Read<ToolPosition>, Read<ToolNormal>,
                 Optional<Read<ToolShapes>>, Read<CurvePosition>);

}  // namespace pulvis
