// Packing files: `pulvis pack` writes them, [[packing]] with kind = "csv" reads them. Numbers are
// written so that reading them back gives identical bits.
#pragma once

#include "scenes/spec/scene.hpp"

#include <string>
#include <vector>

namespace pulvis {

struct FiledParticle {
  int particle = 0;  // index in Scene::particles
  double scale = 1;  // of its outline
  Vec2 position = Vec2::Zero();
  double angle = 0;
};

struct FiledPacking {
  std::vector<FiledParticle> particles;
  std::optional<double> top;  // m, where a punch rests
};

// Throws SceneError with the line of the file.
FiledPacking read_packing(const std::filesystem::path& file, const Scene& scene);

// All particles of the scene.
std::string packing_text(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
