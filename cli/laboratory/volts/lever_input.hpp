// The calibrated lever as given in the settings: numbers, or the summary.json of a run.
#pragma once

#include <filesystem>
#include <optional>

#include "cli/laboratory/volts/volts_spec.hpp"

namespace pulvis::volts {

struct Lever {
  double k_n = 0;             // N/m, along the normal of the surface
  std::optional<double> k_l;  // N/m
  std::optional<double> arm;  // m
  double twist_share = 1;
};

// `folder`: that of the settings. Throws SceneError where the file is no summary of a calibrated lever.
Lever lever_of(const LeverSpec& spec, const std::filesystem::path& folder);

}  // namespace pulvis::volts
