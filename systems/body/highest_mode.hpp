// Signature of the system that follows each particle's highest frequency; see highest_mode.cpp.
#pragma once

#include "components/body.hpp"
#include "components/highest_mode.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/access.hpp"

namespace pulvis {

template <int Points>
void highest_mode(Chunk, Read<Bodies>, Read<Clock>, Read<Position>, Read<ShearModulus>,
                  Read<BulkModulus>, Read<Density>, Read<DeviatoricStress<Points>>,
                  Optional<Read<ContactRules>>, Optional<Read<ContactSupport>>,
                  Optional<Read<MassDamping>>, Optional<Read<StiffnessDamping>>,
                  Optional<Read<ToolServos>>, Write<HighestMode>, Write<ModeGain>,
                  Write<StableTimeStep>);

}  // namespace pulvis
