#include "scenes/scene_files.hpp"

#include <fstream>
#include <span>
#include <sstream>

#include "engine/xxh3.hpp"
#include "scenes/afm_scene.hpp"

namespace pulvis {

std::vector<std::filesystem::path> files_of(const Scene& scene) {
  std::vector<std::filesystem::path> files;
  const auto add = [&](const std::string& name) {
    if (!name.empty()) files.push_back(scene.file.parent_path() / name);
  };
  for (const ParticleSpec& particle : scene.particles)
    if (const auto* traced = std::get_if<PointsOutline>(&particle.outline);
        traced != nullptr && particle.class_of < 0)  // sizes of a packing share their class's file
      add(traced->file);
  for (const PackingSpec& packing : scene.packings) {
    add(packing.file);
    for (const MixtureClass& mixed : packing.classes) add(mixed.size.file);
  }
  for (const ToolSpec& tool : scene.tools) add(tool.relief.file);
  if (scene.afm) add(scene.afm->lever.file);
  if (scene.afm) add(scene.afm->tip.file);
  if (scene.afm && scene.afm->target) add(scene.afm->target->file);
  return files;
}

std::uint64_t hash_with_files(const Scene& scene, std::uint64_t hash) {
  for (const std::filesystem::path& file : files_of(scene)) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    hash = xxh3(std::as_bytes(std::span(content.view())), hash);
  }
  return hash;
}

}  // namespace pulvis
