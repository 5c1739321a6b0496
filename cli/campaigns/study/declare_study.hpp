// Declarations of a study's keys, in the same form as those of a scene.
#pragma once

#include "cli/campaigns/study/analysis/study_spec.hpp"
#include "scenes/language/schema.hpp"

namespace pulvis::schema {

const TableDeclaration<StudySpec>& study_top_level();
const TableDeclaration<VariationSpec>& study_variation();
const TableDeclaration<StudyCurve>& study_curve();
const TableDeclaration<StudyExpect>& study_expect();
const TableDeclaration<StudyFit>& study_fit();
const Language& study_language();

}  // namespace pulvis::schema
