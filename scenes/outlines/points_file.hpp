// Traced outlines from CSV files.
#pragma once

#include <filesystem>
#include <vector>
#include "scenes/outlines/outline_checks.hpp"

namespace pulvis {

// Fills the outline's points from its file, smoothed. Errors name the line in the file.
std::vector<OutlineFault> read_points(const std::filesystem::path& folder, PointsOutline& outline);

}  // namespace pulvis
