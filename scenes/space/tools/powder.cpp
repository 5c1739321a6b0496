#include "scenes/space/tools/powder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/shape.hpp"
#include "components/space/body.hpp"
#include "components/space/shape.hpp"
#include "engine/access.hpp"

namespace pulvis::space {
namespace {

const Shape& shape_in(const World& world, int slot) {
  const Bodies& bodies = world.resource<Bodies>();
  return entry(world.resource<Shapes>().list, entry(bodies.slots, slot).shape);
}

}  // namespace

bool has_face(const ToolSpec& tool) {
  return tool.shape == ToolSpec::Shape::plane || tool.shape == ToolSpec::Shape::punch;
}

Powder powder_of(const World& world, const Scene& scene) {
  const Bodies& bodies = world.resource<Bodies>();
  Powder powder;
  for (const int slot : bodies.slot_of_number) {
    const MaterialSpec& m =
        scene.materials[static_cast<std::size_t>(entry(bodies.slots, slot).material)];
    const double volume = shape_in(world, slot).volume, nu = m.poissons_ratio;
    const double modulus = m.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    powder.volume += volume;
    powder.mass += m.density * volume;
    powder.impedance = std::max(powder.impedance, std::sqrt(m.density * modulus));
  }
  return powder;
}

double section_across(const World& world, const std::vector<BodySpec>& bodies,
                      const Vec3& direction) {
  const Vec3 first = direction.unitOrthogonal(), second = direction.cross(first);
  constexpr double far = std::numeric_limits<double>::infinity();
  Vec2 low(far, far), high(-far, -far);
  const std::vector<int>& slot_of = world.resource<Bodies>().slot_of_number;
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const Vec3& middle = bodies[number].position;
    const Vec2 at(middle.dot(first), middle.dot(second));
    const Vec2 reach = Vec2::Constant(shape_in(world, slot_of[number]).radius);
    low = low.cwiseMin(at - reach);
    high = high.cwiseMax(at + reach);
  }
  return (high - low).prod();
}

}  // namespace pulvis::space
