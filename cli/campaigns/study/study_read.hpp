// Reads a study file and every scene that it refers to. All errors are thrown as one
// SceneError before anything runs.
#pragma once

#include <string>
#include <vector>

#include "cli/campaigns/study/analysis/study_spec.hpp"

namespace pulvis {

// `overrides` apply to every run, after the study's own settings.
Study load_study(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

std::string study_reference();  // docs/study.md

}  // namespace pulvis
