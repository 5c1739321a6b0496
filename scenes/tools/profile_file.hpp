// Measured profiles: heights against x from a CSV file.
#pragma once

#include <filesystem>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// Columns "x" and "height", each with its unit; others are allowed. Heights are levelled: the residuals about
// the least-squares line through them. Throws SceneError where x does not increase from row to row.
std::vector<Vec2> read_profile(const std::filesystem::path& file);

}  // namespace pulvis
