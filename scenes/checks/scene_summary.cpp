#include "scenes/checks/scene_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scenes/checks/solids/class_shape.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/meshes/mesh.hpp"
#include "scenes/packing/packing_file.hpp"

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

std::string summary_of_outline(const ParticleSpec& particle) {
  const Shape shape = make_shape(particle);
  return fmt::format("{}: {}, {}, worst corner sine {:.3f}, shortest edge {:.4g} m\n",
                     particle.name, counted(shape.elements(), "element"),
                     counted(shape.boundary_nodes, "boundary edge"), min_corner_sine(shape),
                     shortest_edge(shape));
}

std::string summary_of_solid(const space::Shape& shape) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& face : shape.faces) smallest = std::min(smallest, face.size);
  return fmt::format(
      "{}: {}, {}, smallest face {:.4g} m wide, surface within {:.2g}% of its mean radius\n",
      shape.name, counted(shape.hexahedra.size(), "element"), counted(shape.faces.size(), "face"),
      smallest, 100 * space::surface_error_share(shape));
}

}  // namespace

std::string packing_summary(const Scene& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.packings.size(); ++i) {
    const PackingSpec& packing = scene.packings[i];
    if (packing.kind != PackingSpec::Kind::random) continue;
    text += fmt::format(
        "packing[{}]: {}, relative density {:.4f}, {}, mean gap to the three nearest neighbours "
        "{:.3g} diameters, mean contacts per particle {:.3g}\n",
        i, counted(packing.placed.size(), "particle"), packing.reached.density,
        container_text(scene, packing, 6), packing.reached.mean_gap,
        2.0 * packing.reached.touches / static_cast<double>(packing.placed.size()));
  }
  return text;
}

std::string mesh_summary(const Scene& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    const ParticleSpec& particle = scene.particles[i];
    text += scene.in_space()  ? summary_of_solid(space::class_shape(scene, i))
            : particle.grains ? summary_of_grains(scene, particle)
                              : summary_of_outline(particle);
  }
  return text;
}

}  // namespace pulvis
