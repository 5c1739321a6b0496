// Small pictures of a run's last frame, as PNG inside a page: elements, particles as fans if there are many, the
// surface of a lever.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/report_encoding.hpp"

namespace pulvis {

struct Thumbnail {
  int width = 0, height = 0;
  std::vector<float> pixels;  // the field, row by row from the top; NaN where nothing is drawn
  std::string field, unit;
  Range range;  // of the field, ignoring a hundredth at either end
};

// At most `side` pixels wide and high; nothing for a run without a complete frame.
std::optional<Thumbnail> thumbnail_of(const std::filesystem::path& run_h5, int side);

// As data:image/png;base64, one byte per pixel before deflation.
std::string thumbnail_png(const Thumbnail& thumbnail, const Range& colours);

// Maximum width and height of each of `count` pictures so that all fit into `budget` pixels; 0: too many.
int thumbnail_side(std::size_t count, std::size_t budget);

}  // namespace pulvis
