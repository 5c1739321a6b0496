// Declarations of a probe's keys, in the same form as those of a scene.
#pragma once

#include "cli/campaigns/probe/probe_spec.hpp"
#include "scenes/language/schema.hpp"

namespace pulvis::schema {

const TableDeclaration<ProbeSpec>& probe_top_level();
const TableDeclaration<ProbePath>& probe_path();
const TableDeclaration<ProbePowder>& probe_powder();
const TableDeclaration<ProbeSpec>& probe_probe();
const TableDeclaration<GivenDirection>& probe_direction();
const TableDeclaration<ProbeSpec>& probe_yield();
const Language& probe_language();

}  // namespace pulvis::schema
