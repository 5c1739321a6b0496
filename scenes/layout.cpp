#include "scenes/layout.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <random>

#include "engine/portable_math.hpp"
#include "scenes/hilbert.hpp"
#include "scenes/meshes/mesh.hpp"

namespace pulvis {

namespace {

// The order of particles in memory: neighbours in space are close in memory, regardless
// of their order in the scene.
class MemoryOrder {
 public:
  explicit MemoryOrder(const std::vector<BodySpec>& bodies) {
    for (const BodySpec& body : bodies) {
      low_ = low_.cwiseMin(in_plane(body.position));
      high_ = high_.cwiseMax(in_plane(body.position));
    }
  }
  std::uint64_t operator()(const BodySpec& body) const {
    constexpr int order = 16;  // cells much smaller than particles
    const double size = std::max((high_ - low_).maxCoeff(), std::numeric_limits<double>::min());
    const Vec2 share = (in_plane(body.position) - low_) / size;
    const auto cell = [](double s) { return static_cast<std::uint32_t>(s * ((1 << order) - 1)); };
    return hilbert_number(order, cell(share.x()), cell(share.y()));
  }

 private:
  Vec2 low_ = Vec2::Constant(std::numeric_limits<double>::max());
  Vec2 high_ = Vec2::Constant(std::numeric_limits<double>::lowest());
};

}  // namespace

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

std::vector<std::vector<Placed>> placed_by_class(const Scene& scene,
                                                 const std::vector<BodySpec>& bodies) {
  std::mt19937_64 random(scene.seed);
  std::vector<std::vector<Placed>> classes(scene.particles.size() + scene.grains.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto which = static_cast<std::size_t>(bodies[i].particle);
    const ParticleSpec& spec = scene.class_of(bodies[i]);
    const double phase =
        spec.random_mesh_phase ? 2 * std::numbers::pi * uniform(random) : spec.mesh_phase;
    classes[which].push_back({&bodies[i], static_cast<int>(i), bodies[i].angle + phase});
  }
  const MemoryOrder order(bodies);
  for (std::vector<Placed>& placed : classes)
    std::ranges::stable_sort(placed, {}, [&](const Placed& p) { return order(*p.body); });
  return classes;
}

Layout lay_out(const Scene& scene, const std::vector<std::vector<Placed>>& classes,
               std::size_t particles) {
  Layout layout;
  layout.bodies.thickness = scene.thickness;
  layout.bodies.formulation = scene.element.formulation;
  layout.bodies.slot_of_number.assign(particles, Bodies::empty_slot);
  int control = 0;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    if (classes[c].empty()) continue;
    const int shape = static_cast<int>(layout.bodies.shapes.size());
    const ParticleSpec& spec = scene.class_of(*classes[c].front().body);
    layout.bodies.shapes.push_back(make_shape(spec));
    layout.classes.of_shape.push_back(static_cast<int>(c));
    const std::size_t lanes = (classes[c].size() + lane_count - 1) / lane_count * lane_count;
    for (std::size_t i = 0; i < lanes; ++i) {
      const bool there = i < classes[c].size();
      Bodies::Slot slot{there ? classes[c][i].number : Bodies::empty_slot, shape, spec.material,
                        control, there ? classes[c][i].body->parent : Bodies::empty_slot};
      control += layout.bodies.shapes.back().control_points();
      if (there)
        layout.bodies.slot_of_number[static_cast<std::size_t>(slot.number)] =
            static_cast<int>(layout.bodies.slots.size());
      layout.bodies.slots.push_back(slot);
      layout.placed.push_back(there ? &classes[c][i] : nullptr);
    }
  }
  layout.bodies.hold_all();
  return layout;
}

std::vector<Vec2> turned_nodes(const Shape& shape, double turn) {
  const double c = portable::cos(turn), s = portable::sin(turn);
  std::vector<Vec2> nodes;
  nodes.reserve(shape.nodes.size());
  for (const Point& p : shape.nodes) nodes.emplace_back(c * p[0] - s * p[1], s * p[0] + c * p[1]);
  return nodes;
}

std::vector<Vec2> placed_nodes(const Shape& shape, const Placed& placed) {
  std::vector<Vec2> nodes = turned_nodes(shape, placed.turn);
  for (Vec2& node : nodes) node = in_plane(placed.body->position) + node;
  return nodes;
}

}  // namespace pulvis
