// Small pictures of a run's last frame, as PNG inside a page: elements, particles as fans where there are many, the
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
  std::vector<float> pixels;  // the field, row by row from above; NaN where nothing is
  std::string field, unit;
  Range range;  // of the field, a hundredth left out at either end
};

// At most `side` pixels wide and high; nothing of a run without a whole frame.
std::optional<Thumbnail> thumbnail_of(const std::filesystem::path& run_h5, int side);

// As data:image/png;base64, one byte a pixel before it is deflated.
std::string thumbnail_png(const Thumbnail& thumbnail, const Range& colours);

// How wide and high each of `count` can be so that all fit into `budget` pixels; 0: too many.
int thumbnail_side(std::size_t count, std::size_t budget);

}  // namespace pulvis
