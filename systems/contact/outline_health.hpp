// outline_health: stops a run in which an outline has gone through itself; see its source file.
#pragma once

#include "components/hollow.hpp"
#include "components/run_state.hpp"
#include "engine/access.hpp"

namespace pulvis {

void outline_health(Read<Bodies>, Read<Clock>, Read<Position>, Optional<Read<ContactRules>>,
                    Optional<Read<Hollows>>);

}  // namespace pulvis
