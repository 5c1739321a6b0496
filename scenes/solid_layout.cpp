#include "scenes/solid_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "engine/chunk_lane.hpp"
#include "engine/portable_math.hpp"
#include "scenes/checks/solids/class_shape.hpp"
#include "scenes/layout.hpp"

namespace pulvis::space {
namespace {

// Uniform over all rotations (Shoemake 1992), identical on every machine.
Rotation random_rotation(std::mt19937_64& random) {
  const double u = uniform(random), a = 2 * std::numbers::pi * uniform(random),
               b = 2 * std::numbers::pi * uniform(random);
  const double p = std::sqrt(1 - u), q = std::sqrt(u);
  return Rotation(q * portable::cos(b), p * portable::sin(a), p * portable::cos(a),
                  q * portable::sin(b));
}

struct Numbered {
  Placed placed;
  int number = 0;  // of the particle in the scene
  std::uint64_t order = 0;
};

// Index of a cell on a curve through all cells of a cube (Morton 1966): bits of x, y, z interleaved.
class CurveThroughSpace {
 public:
  explicit CurveThroughSpace(const std::vector<BodySpec>& bodies) {
    for (const BodySpec& body : bodies) {
      low_ = low_.cwiseMin(body.position);
      high_ = high_.cwiseMax(body.position);
    }
  }
  std::uint64_t operator()(const Vec3& position) const {
    constexpr int bits = 16;  // cells much smaller than particles
    const double size = std::max((high_ - low_).maxCoeff(), std::numeric_limits<double>::min());
    std::uint64_t number = 0;
    for (int k = 0; k < 3; ++k) {
      const double share = (position[k] - low_[k]) / size;
      const auto cell = static_cast<std::uint64_t>(share * ((1 << bits) - 1));
      for (int b = 0; b < bits; ++b) number |= (cell >> b & 1U) << (3 * b + k);
    }
    return number;
  }

 private:
  Vec3 low_ = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high_ = Vec3::Constant(std::numeric_limits<double>::lowest());
};

std::vector<std::vector<Numbered>> by_classes(const Scene& scene,
                                              const std::vector<BodySpec>& bodies) {
  std::mt19937_64 random(scene.seed);
  std::vector<std::vector<Numbered>> classes(scene.particles.size());
  const CurveThroughSpace curve(bodies);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto which = static_cast<std::size_t>(bodies[i].particle);
    Rotation turn = bodies[i].rotation;
    if (scene.particles[which].random_mesh_phase) turn = turn * random_rotation(random);
    classes[which].push_back({{&bodies[i], turn}, static_cast<int>(i), curve(bodies[i].position)});
  }
  for (std::vector<Numbered>& of_class : classes)
    std::ranges::stable_sort(of_class, {}, &Numbered::order);
  return classes;
}

void add_solid_class(Layout& layout, const Scene& scene, std::size_t particle,
                     const std::vector<Numbered>& particles, int& face) {
  const int shape = static_cast<int>(layout.shapes.list.size());
  layout.shapes.list.push_back(class_shape(scene, particle));
  const std::size_t lanes = (particles.size() + lane_count - 1) / lane_count * lane_count;
  for (std::size_t i = 0; i < lanes; ++i) {
    const bool there = i < particles.size();
    const Bodies::Slot slot{there ? particles[i].number : Bodies::empty_slot, shape,
                            scene.particles[particle].material, face, Bodies::empty_slot};
    face += static_cast<int>(layout.shapes.list.back().faces.size());
    if (there)
      layout.bodies.slot_of_number[static_cast<std::size_t>(slot.number)] =
          static_cast<int>(layout.bodies.slots.size());
    layout.bodies.slots.push_back(slot);
    layout.placed.push_back(there ? std::optional(particles[i].placed) : std::nullopt);
  }
}

}  // namespace

Layout lay_out(const Scene& scene, const std::vector<BodySpec>& bodies) {
  Layout layout;
  layout.bodies.formulation = scene.element.formulation;
  layout.bodies.slot_of_number.assign(bodies.size(), Bodies::empty_slot);
  const auto classes = by_classes(scene, bodies);
  int face = 0;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    if (classes[c].empty()) continue;
    layout.classes.of_shape.push_back(static_cast<int>(c));
    add_solid_class(layout, scene, c, classes[c], face);
  }
  layout.bodies.hold_all();
  return layout;
}

}  // namespace pulvis::space
