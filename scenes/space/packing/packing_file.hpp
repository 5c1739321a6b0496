// Packing files: `pulvis pack` writes them, [[packing]] with kind = "csv" reads them. Numbers are written so that reading
// them back gives identical bits. Columns class, x, y, z, qw, qx, qy, qz and, if any size differs from its class, scale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

struct FiledParticle {
  int particle = 0;  // index in Scene::particles
  double scale = 1;  // of its shape
  Vec3 position = Vec3::Zero();
  Rotation rotation = Rotation::Identity();
};

struct FiledPacking {
  std::vector<FiledParticle> particles;
  std::optional<double> top;  // m, where a punch rests
};

// Throws SceneError with the line of the file. Quaternions are normalised; (0, 0, 0, 0) is refused.
FiledPacking read_packing(const std::filesystem::path& file, const Scene& scene);

// All particles of the scene.
std::string packing_text(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
