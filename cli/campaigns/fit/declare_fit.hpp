// Declarations of a fit's keys, in the same form as those of a scene.
#pragma once

#include "cli/campaigns/fit/plate_fit.hpp"
#include "scenes/language/schema.hpp"

namespace pulvis::schema {

const TableDeclaration<PlateFitSpec>& fit_top_level();
const TableDeclaration<SoughtKey>& fit_parameter();
const TableDeclaration<PlateMeasured>& fit_measured();
const TableDeclaration<PlateFitSpec>& fit_fit();
const Language& fit_language();

}  // namespace pulvis::schema
