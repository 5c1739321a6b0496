// Packing files: `pulvis pack` writes them, [[packing]] with kind = "csv" reads them. Numbers are written so that reading
// them back gives identical bits. Columns: class, x, y, in two dimensions angle, in three z, qw, qx, qy, qz; and scale, if
// any size differs from its class.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct FiledParticle {
  BodySpec body;
  double scale = 1;  // of its class's shape
};

struct FiledPacking {
  std::vector<FiledParticle> particles;
  std::optional<double> top;  // m, where a punch rests
};

// Throws SceneError with the line of the file. Quaternions are normalised; (0, 0, 0, 0) is refused.
FiledPacking read_packing(const std::filesystem::path& file, const Scene& scene);

// The container of a packing up to its top, with so many significant digits.
std::string container_text(const Scene& scene, const PackingSpec& packing, int digits);

// All particles of the scene.
std::string packing_text(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
