#include "scenes/tools/powder.hpp"

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
#include "scenes/outlines/outline.hpp"

namespace pulvis {
namespace {

const space::Shape& shape_of(const World& world, std::size_t number) {
  const Bodies& bodies = world.resource<Bodies>();
  const int slot = bodies.slot_of_number[number];
  return entry(world.resource<space::Shapes>().list, entry(bodies.slots, slot).shape);
}

}  // namespace

template <class D>
Powder powder_of(const World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  Powder powder;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const ParticleSpec& particle = scene.particles[static_cast<std::size_t>(bodies[i].particle)];
    const MaterialSpec& m = scene.materials[static_cast<std::size_t>(particle.material)];
    double content = 0;
    if constexpr (D::axes == 2)
      content = outline_area(particle.outline);
    else
      content = shape_of(world, i).volume;
    const double nu = m.poissons_ratio;
    const double modulus = m.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    const double mass = m.density * content * thickness_of<D>(scene);
    powder.content += content;
    powder.mass += mass;
    powder.centre += mass * bodies[i].position;
    powder.impedance = std::max(powder.impedance, std::sqrt(m.density * modulus));
  }
  powder.centre /= powder.mass;
  return powder;
}

template <>
double section_across<TwoD>(const World&, const Scene& scene, const std::vector<BodySpec>& bodies,
                            const Vec3& direction) {
  double low = 1e300, high = -1e300;
  for (const BodySpec& body : bodies) {
    const auto& outline = scene.particles[static_cast<std::size_t>(body.particle)].outline;
    const double radius = std::sqrt(outline_area(outline) / std::numbers::pi);
    const double at = body.position.x() * direction.y() - body.position.y() * direction.x();
    low = std::min(low, at - radius);
    high = std::max(high, at + radius);
  }
  return high - low;
}

template <>
double section_across<ThreeD>(const World& world, const Scene&, const std::vector<BodySpec>& bodies,
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
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const Vec3 middle = bodies[number].position - bodies[0].position;
    const double reach = shape_of(world, number).radius;
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

double volume_of_particles(const World& world) {
  double volume = 0;
  for (std::size_t i = 0; i < world.resource<Bodies>().slot_of_number.size(); ++i)
    volume += shape_of(world, i).volume;
  return volume;
}

template Powder powder_of<TwoD>(const World&, const Scene&, const std::vector<BodySpec>&);
template Powder powder_of<ThreeD>(const World&, const Scene&, const std::vector<BodySpec>&);

}  // namespace pulvis
