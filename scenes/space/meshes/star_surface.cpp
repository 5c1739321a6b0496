#include "scenes/space/meshes/star_surface.hpp"

#include <stdexcept>

#include "scenes/space/meshes/round_surfaces.hpp"

namespace pulvis::space {

std::unique_ptr<StarSurface> star_surface(const ParticleShape& shape) {
  return std::visit(
      [](const auto& s) -> std::unique_ptr<StarSurface> {
        if constexpr (requires { round_surface(s); })
          return round_surface(s);
        else
          throw std::logic_error("a shape without a surface");
      },
      shape);
}

}  // namespace pulvis::space
