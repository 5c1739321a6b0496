// What the dimension of a scene changes in messages and lists.
#pragma once

#include <span>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct DimensionWords {
  const char* components;  // of a vector: how many
  const char* elements;    // of a mesh
  const char* sides;       // of the elements, where particles touch
  const char* edges;       // the same in short
  const char* extent;      // of one
  const char* finer_sides;
  const char* round;        // particles with a diameter
  const char* dies;         // to which a relative density can refer
  const char* other_moves;  // of a stage, besides tools
  const char* axes;
};

inline const DimensionWords& words_of(const Scene& scene) {
  static constexpr DimensionWords two{
      "two",
      "quads",
      "boundary edges",
      "edges",
      "long",
      "finer edges",
      "discs and rings",
      "in a periodic cell, or in a scene whose tools are four planes with normals along +x, -x, +y "
      "and -y",
      ", a [stage.cell]",
      "xy"};
  static constexpr DimensionWords three{"three",
                                        "hexahedra",
                                        "faces",
                                        "faces",
                                        "wide",
                                        "smaller faces",
                                        "spheres",
                                        "in a periodic cell, with six planes with normals along "
                                        "+x, -x, +y, -y, +z and -z, or a cylindrical die and a "
                                        "plane or punch at either end",
                                        ", a [stage.cell]",
                                        "xyz"};
  return scene.in_space() ? three : two;
}

// Those of a vector that the scene has.
inline std::span<const double> components_of(const Scene& scene, const double* v) {
  return {v, static_cast<std::size_t>(scene.dimension)};
}

}  // namespace pulvis
