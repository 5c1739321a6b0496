// Pictures of a raster, line by line, both ways: how high the surface is, how the lever bends and how it
// twists.
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

// Of the lines that were finished, of every raster of the scene.
std::vector<AfmImage> raster_images(const Scene& scene, const AfmHistory& history);

}  // namespace pulvis
