// Overlaps of particles with each other and with tools, as found in either dimension.
#pragma once

#include <cstddef>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct Overlap {
  std::size_t particle;
  std::size_t other;  // particle or tool
  double depth;       // m
};

struct Overlaps {
  std::vector<Overlap> between_particles, with_tools;
  std::vector<bool>
      reversed;           // [tools]: if it were flipped, every particle would be in front of it
  std::size_t pairs = 0;  // that were close enough to be checked
};

// Whether particles may be all around a tool, not only in front of it.
inline bool is_solid(const ToolSpec& tool) {
  return tool.shape == ToolSpec::Shape::punch || tool.shape == ToolSpec::Shape::stl || tool.height;
}

}  // namespace pulvis
