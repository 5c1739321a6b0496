#include "scenes/checks/solids/class_shape.hpp"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/meshes/hexahedra/mesh.hpp"

namespace pulvis::space {

Shape class_shape(const Scene& scene, std::size_t particle) {
  constexpr double farthest = 0.5;
  const ParticleSpec& spec = scene.particles.at(particle);
  try {
    Shape shape = space::make_shape(spec);
    if (const double share = surface_error_share(shape); share > farthest)
      throw std::invalid_argument(
          fmt::format("its smoothed surface is {:.0f}% of the mean radius off", 100 * share));
    return shape;
  } catch (const std::invalid_argument& error) {
    const std::size_t declared =
        spec.class_of < 0 ? particle : static_cast<std::size_t>(spec.class_of);
    throw SceneError(
        {{scene.file_of(spec.mark).string(), spec.mark.line, spec.mark.column, "",
          fmt::format("particle[{}].mesh", declared),
          fmt::format(
              "{}: the mesh is too coarse for this shape, allowed: a rounder shape, or more "
              "divisions",
              error.what())}});
  }
}

double surface_error_share(const Shape& shape) {
  return shape.surface_error / portable::cbrt(0.75 / std::numbers::pi * shape.true_volume);
}

std::vector<std::string> coarse_surface_warnings(const Scene& scene) {
  constexpr double far = 0.05;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    if (scene.particles[i].class_of >= 0) continue;  // differs only in size
    const Shape shape = class_shape(scene, i);
    if (surface_error_share(shape) <= far) continue;
    lines.push_back(fmt::format(
        "the contact surface of '{}' deviates by up to {:.3g} m from its shape, {:.0f}% of its "
        "mean radius: sharp edges are rounded off; use more divisions, or a rounder shape",
        shape.name, shape.surface_error, 100 * surface_error_share(shape)));
  }
  return lines;
}

}  // namespace pulvis::space
