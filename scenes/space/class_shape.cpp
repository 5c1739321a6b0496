#include "scenes/space/class_shape.hpp"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "engine/result_cache.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/space/meshes/mesh.hpp"

namespace pulvis::space {
namespace {

struct ShapeKey {
  ParticleShape shape;
  MeshSpec mesh;
  bool operator==(const ShapeKey&) const = default;
};

std::size_t bytes_of(const Shape& shape) {
  return shape.hexahedra.size() *
         (sizeof(shape.hexahedra[0]) + sizeof(shape.element[0]) + sizeof(shape.gauss[0]));
}

// The layout of the particles, the summary and the warnings of a scene ask for the same shapes, and so do the runs of a study.
Shape known_shape(const ParticleSpec& particle) {
  static ResultCache<ShapeKey, Shape> cache(32 << 20);  // bytes, about
  const auto make = [&](const ShapeKey&) { return make_shape(particle); };
  const auto size = [&](const Shape& made) { return stl_bytes(particle.shape) + bytes_of(made); };
  Shape shape = cache.get({particle.shape, particle.mesh}, make, size);
  shape.name = particle.name;
  return shape;
}

}  // namespace

Shape class_shape(const Scene& scene, std::size_t particle) {
  const ParticleSpec& spec = scene.space->particles.at(particle);
  try {
    return known_shape(spec);
  } catch (const std::invalid_argument& error) {
    const std::size_t declared =
        spec.class_of < 0 ? particle : static_cast<std::size_t>(spec.class_of);
    throw SceneError(
        {{scene.file_of(spec.mark).string(), spec.mark.line, spec.mark.column, "",
          fmt::format("particle[{}].mesh", declared),
          fmt::format("{}: the mesh is too coarse for this shape, allowed: more divisions, or a "
                      "rounder shape",
                      error.what())}});
  }
}

double surface_error_share(const Shape& shape) {
  return shape.surface_error / portable::cbrt(0.75 / std::numbers::pi * shape.true_volume);
}

std::vector<std::string> coarse_surface_warnings(const Scene& scene) {
  constexpr double far = 0.05;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < scene.space->particles.size(); ++i) {
    if (scene.space->particles[i].class_of >= 0) continue;  // of another size only
    const Shape shape = class_shape(scene, i);
    if (surface_error_share(shape) <= far) continue;
    lines.push_back(fmt::format(
        "the surface of '{}' that contacts see stands up to {:.3g} m off its shape, {:.0f}% of "
        "its mean radius: sharp bends are rounded off; take more divisions, or a rounder shape",
        shape.name, shape.surface_error, 100 * surface_error_share(shape)));
  }
  return lines;
}

}  // namespace pulvis::space
