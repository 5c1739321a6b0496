#include "scenes/space/tools/powder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "components/body.hpp"
#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "engine/portable_math.hpp"

namespace pulvis::space {
namespace {

const Shape& shape_in(const World& world, int slot) {
  const Bodies& bodies = world.resource<Bodies>();
  return entry(world.resource<Shapes>().list, entry(bodies.slots, slot).shape);
}

}  // namespace

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
  constexpr int sides = 360;
  constexpr double angle = 2 * std::numbers::pi / sides;
  const double cosine = portable::cos(angle), sine = portable::sin(angle);
  const Vec3 first = direction.unitOrthogonal(), second = direction.cross(first);
  std::array<Vec3, sides> outward;
  std::array<double, sides> support;  // m, distance of a side from the first particle
  support.fill(-std::numeric_limits<double>::infinity());
  for (int i = 0; i < sides; ++i)
    entry(outward, i) = portable::cos(i * angle) * first + portable::sin(i * angle) * second;
  const std::vector<int>& slot_of = world.resource<Bodies>().slot_of_number;
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const Vec3 middle = bodies[number].position - bodies[0].position;
    const double reach = shape_in(world, slot_of[number]).radius;
    for (int i = 0; i < sides; ++i)
      entry(support, i) = std::max(entry(support, i), middle.dot(entry(outward, i)) + reach);
  }
  // The length of a side follows from its distance and those of its neighbours.
  double twice = 0;
  for (int i = 0; i < sides; ++i) {
    const double before = entry(support, (i + sides - 1) % sides),
                 after = entry(support, (i + 1) % sides);
    const double length = (before + after - 2 * cosine * entry(support, i)) / sine;
    twice += entry(support, i) * length;
  }
  return twice / 2;
}

}  // namespace pulvis::space
