// Output files and messages of the wedge calibration of measured friction loops.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/laboratory/lab_settings.hpp"
#include "scenes/wedge/wedge_calibration.hpp"

namespace pulvis {

struct WedgeReduction {
  lab::LoadedSettings loaded;
  std::filesystem::path file;  // of the loops
  std::vector<wedge::Loop> loops;
  wedge::Calibration calibration;
};

// From the loops that the settings name; throws SceneError if they do not fit any friction.
WedgeReduction wedge_reduction(const lab::LoadedSettings& loaded);

// Content of summary.json, all in SI units.
nlohmann::ordered_json wedge_json(const WedgeReduction& reduction);

// Which of the two roots the result is, why, and the other one.
nlohmann::ordered_json wedge_root_json(const wedge::Calibration& calibration);

// Where the loops do not determine the friction coefficient.
std::vector<std::string> wedge_warnings(const wedge::Calibration& calibration);

// summary.json, facets.csv and the settings.
void write_wedge(const std::filesystem::path& folder, const WedgeReduction& reduction);

std::string wedge_text(const wedge::Calibration& calibration);

}  // namespace pulvis
