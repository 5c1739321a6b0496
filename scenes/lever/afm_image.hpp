// Images of a raster scan, line by line, trace and retrace: surface height, bending and
// twist of the lever.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/files/record.hpp"
#include "scenes/lever/afm_loop.hpp"

namespace pulvis {

struct AfmImage {
  SeriesInfo info;  // name: action_2/topography_trace
  std::uint64_t lines = 0, pixels = 0;
  PixelSpacing spacing;
  std::vector<double> values;  // line by line, pixels in the order of the forward scan
};

// Of the completed lines of every raster of the scene.
std::vector<AfmImage> raster_images(const Scene& scene, const AfmHistory& history);

}  // namespace pulvis
