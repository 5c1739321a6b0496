#include "scenes/space/space_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scenes/language/counted.hpp"
#include "scenes/space/class_shape.hpp"

namespace pulvis::space {

std::string packing_summary(const Scene& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.packings.size(); ++i) {
    const PackingSpec& packing = scene.packings[i];
    if (packing.kind != PackingSpec::Kind::random) continue;
    text += fmt::format(
        "packing[{}]: {}, relative density {:.4f}, {:.6g} m high, mean gap to the nearest "
        "neighbours {:.3g} diameters, mean contacts per particle {:.3g}\n",
        i, counted(packing.placed.size(), "particle"), packing.reached.density,
        packing.top - packing.container.corner.z(), packing.reached.mean_gap,
        2.0 * packing.reached.touches / static_cast<double>(packing.placed.size()));
  }
  return text;
}

std::string mesh_summary(const Scene& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    const Shape shape = class_shape(scene, i);
    double smallest = std::numeric_limits<double>::infinity();
    for (const Shape::Face& face : shape.faces) smallest = std::min(smallest, face.size);
    text += fmt::format(
        "{}: {}, {}, smallest face {:.4g} m wide, surface within {:.2g}% of its mean radius\n",
        shape.name, counted(shape.hexahedra.size(), "element"), counted(shape.faces.size(), "face"),
        smallest, 100 * surface_error_share(shape));
  }
  return text;
}

}  // namespace pulvis::space
