// Packings in files: `pulvis pack` writes them, [[packing]] with kind = "csv" reads them. Numbers are written so that they are
// read back bit for bit. Columns class, x, y, z, qw, qx, qy, qz and, where not all are as the class says, scale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

struct FiledParticle {
  int particle = 0;  // position in SpaceScene::particles
  double scale = 1;  // of its shape
  Vec3 position = Vec3::Zero();
  Rotation rotation = Rotation::Identity();
};

struct FiledPacking {
  std::vector<FiledParticle> particles;
  std::optional<double> top;  // m, where a punch rests
};

// Throws SceneError at the file's line. A quaternion that is not of length 1 is scaled to it; (0, 0, 0, 0) is refused.
FiledPacking read_packing(const std::filesystem::path& file, const Scene& scene);

// All particles of the scene.
std::string packing_text(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
