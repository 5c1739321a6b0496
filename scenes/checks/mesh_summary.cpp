#include "scenes/checks/mesh_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scenes/language/counted.hpp"
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
      "{}: {} and {} in {}, worst corner sine {:.3f}, shortest edge "
      "{:.4g} m\n",
      particle.name, counted(grains, "grain"), counted(elements, "element"),
      counted(particle.tessellations.size(), "tessellation"), sine, edge);
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
    text += fmt::format("{}: {}, {}, worst corner sine {:.3f}, shortest edge {:.4g} m\n",
                        particle.name, counted(shape.elements(), "element"),
                        counted(shape.boundary_nodes, "boundary edge"), min_corner_sine(shape),
                        shortest_edge(shape));
  }
  return text;
}

}  // namespace pulvis
