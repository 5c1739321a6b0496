// What the wedge calibration of measured friction loops leaves in its folder and prints.
#pragma once

#include <filesystem>
#include <string>

#include "scenes/lab_settings.hpp"
#include "scenes/wedge_calibration.hpp"

namespace pulvis {

// Of the loops that the settings name; throws SceneError where they fit no friction.
wedge::Calibration wedge_calibration(const lab::Settings& settings);

// summary.json, facets.csv and the settings.
void write_wedge(const std::filesystem::path& folder, const lab::LoadedSettings& loaded,
                 const wedge::Calibration& calibration);

std::string wedge_text(const wedge::Calibration& calibration);

}  // namespace pulvis
