#include "scenes/checks/mesh_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scenes/meshes/mesh.hpp"

namespace pulvis {
namespace {

std::string summary_of_grains(const Scene& scene, const ParticleSpec& particle) {
  int grains = 0, elements = 0;
  double sine = 1, edge = std::numeric_limits<double>::infinity();
  for (const auto& variant : particle.tessellations)
    for (const GrainPlace& place : variant) {
      const Shape shape = make_shape(scene.grains[static_cast<std::size_t>(place.grain)]);
      ++grains;
      elements += shape.elements();
      sine = std::min(sine, min_corner_sine(shape));
      edge = std::min(edge, shortest_edge(shape));
    }
  return fmt::format(
      "{}: {} grains and {} elements in {} tessellations, worst corner sine {:.3f}, shortest edge "
      "{:.4g} m\n",
      particle.name, grains, elements, particle.tessellations.size(), sine, edge);
}

}  // namespace

std::string mesh_summary(const Scene& scene) {
  std::string text;
  for (const ParticleSpec& particle : scene.particles) {
    if (particle.grains) {
      text += summary_of_grains(scene, particle);
      continue;
    }
    const Shape shape = make_shape(particle);
    text += fmt::format(
        "{}: {} elements, {} boundary edges, worst corner sine {:.3f}, shortest edge {:.4g} m\n",
        particle.name, shape.elements(), shape.boundary_nodes, min_corner_sine(shape),
        shortest_edge(shape));
  }
  return text;
}

}  // namespace pulvis
