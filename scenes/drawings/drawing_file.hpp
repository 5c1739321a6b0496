// Reads drawings; the file extension selects the format.
#pragma once

#include <filesystem>
#include <string>

#include "scenes/drawings/chains.hpp"

namespace pulvis::drawing {

bool is_drawing(const std::filesystem::path& path);

// `text` is the content of the file; `unit` and `layer`: svg_outline.hpp, dxf_outline.hpp.
std::vector<Chain> chains_in(const std::filesystem::path& path, const std::string& text,
                             const std::string& unit, const std::string& layer);

}  // namespace pulvis::drawing
