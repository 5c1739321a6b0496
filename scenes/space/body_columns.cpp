#include "scenes/space/body_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "components/body.hpp"
#include "components/space/formulation.hpp"
#include "engine/entry.hpp"
#include "engine/portable_math.hpp"
#include "scenes/spec/yield.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis::space {
namespace {

// What the materials require.
struct MaterialNeeds {
  bool plastic = false, curved = false, damped = false;
};

MaterialNeeds needs_of(const Scene& scene) {
  MaterialNeeds needs;
  needs.plastic = any_material_yields(scene);
  for (const MaterialSpec& m : scene.materials) {
    needs.curved = needs.curved || m.flow;
    needs.damped = needs.damped || m.damped();
  }
  return needs;
}

template <class Count>
std::vector<std::int32_t> rows_by_chunk(const Bodies& bodies, const Shapes& shapes,
                                        const Count& count) {
  std::vector<std::int32_t> rows;
  for (int c = 0; c < bodies.chunks(); ++c)
    rows.push_back(static_cast<std::int32_t>(
        count(entry(shapes.list, entry(bodies.slots, c * lane_count).shape))));
  return rows;
}

template <class F>
void add_element_columns(World& world, const MaterialNeeds& needs) {
  world.add<DeviatoricStress<ThreeD, F::points>>();
  world.add<MeanStress<1>>();
  if (F::stabilised) world.add<HourglassEnergy>();
  if (!needs.plastic) return;
  world.add<CpInverse<ThreeD, F::points>>();
  world.add<PlasticStrain<F::points>>();
  if (F::stabilised) {
    world.add<PlasticHourglass<ThreeD>>();
    world.add<HourglassWork>();
  }
}

void add_particle_columns(World& world, const MaterialNeeds& needs) {
  world.add<ShearModulus>();
  world.add<BulkModulus>();
  world.add<Density>();
  world.add<MinJacobian>();
  world.add<WorstElement>();
  world.add<StableTimeStep>();
  world.add<KineticEnergy>();
  world.add<ElasticEnergy>();
  if (needs.damped) {
    world.add<DampingForce<ThreeD>>();
    world.add<MassDamping>();
    world.add<StiffnessDamping>();
    world.add<DampingWork>();
  }
  if (!needs.plastic) return;
  world.add<YieldStress>();
  world.add<HardeningModulus>();
  world.add<PlasticWork>();
  world.add<WorkBeyondHardening>();
  if (needs.curved) world.add<ReturnResidual>();
}

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

}  // namespace

Rotation random_rotation(std::mt19937_64& random) {
  const double u = uniform(random), a = 2 * std::numbers::pi * uniform(random),
               b = 2 * std::numbers::pi * uniform(random);
  const double p = std::sqrt(1 - u), q = std::sqrt(u);
  return Rotation(q * portable::cos(b), p * portable::sin(a), p * portable::cos(a),
                  q * portable::sin(b));
}

void add_body_columns(World& world, const Scene& scene, const Bodies& bodies,
                      const Shapes& shapes) {
  const MaterialNeeds needs = needs_of(scene);
  world.add_table<Node>(
      rows_by_chunk(bodies, shapes, [](const Shape& s) { return s.nodes.size(); }));
  world.add_table<Element>(
      rows_by_chunk(bodies, shapes, [](const Shape& s) { return s.elements(); }));
  world.add_table<Particle>(rows_by_chunk(bodies, shapes, [](const Shape&) { return 1; }));
  world.add<Position<ThreeD>>();
  world.add<Velocity<ThreeD>>();
  world.add<InternalForce<ThreeD>>();
  with_hexahedra(bodies.formulation, [&]<class F>(F) { add_element_columns<F>(world, needs); });
  add_particle_columns(world, needs);
}

void fill_bodies(World& world, const std::vector<std::optional<Placed>>& placed,
                 const Bodies& bodies, const Shapes& shapes) {
  auto& x = world.column<Position<ThreeD>>();
  auto& v = world.column<Velocity<ThreeD>>();
  bodies.for_own_lanes([&](int slot) {
    const auto& at = entry(placed, slot);
    const ChunkLane where(slot);
    const Shape& shape = entry(shapes.list, entry(bodies.slots, slot).shape);
    const Eigen::Matrix3d turn = at ? at->turn.toRotationMatrix() : Eigen::Matrix3d::Identity();
    Lane* node_x = x.lanes() + 3 * entry(x.table.chunk_begin, where.chunk.index);
    Lane* node_v = v.lanes() + 3 * entry(v.table.chunk_begin, where.chunk.index);
    for (const Point& p : shape.nodes) {
      const Vec3 arm = turn * Vec3(p[0], p[1], p[2]);
      const Vec3 position = at ? Vec3(at->body->position + arm) : arm;
      const Vec3 velocity =
          at ? Vec3(at->body->velocity + at->body->angular_velocity.cross(arm)) : Vec3::Zero();
      for (int k = 0; k < 3; ++k) {
        (node_x++)[0][where.lane] = position[k];
        (node_v++)[0][where.lane] = velocity[k];
      }
    }
  });
}

void fill_materials(World& world, const Scene& scene, const Bodies& bodies) {
  for (std::size_t slot = 0; slot < bodies.slots.size(); ++slot) {
    const MaterialSpec& m = entry(scene.materials, bodies.slots[slot].material);
    world.column<ShearModulus>().values()[slot] = m.youngs_modulus / (2 * (1 + m.poissons_ratio));
    world.column<BulkModulus>().values()[slot] =
        m.youngs_modulus / (3 * (1 - 2 * m.poissons_ratio));
    world.column<Density>().values()[slot] = m.density;
    if (world.has<MassDamping>()) {
      world.column<MassDamping>().values()[slot] = m.mass_damping;
      world.column<StiffnessDamping>().values()[slot] = m.stiffness_damping;
    }
    if (!world.has<YieldStress>()) continue;
    world.column<YieldStress>().values()[slot] =
        m.yield_stress.value_or(std::numeric_limits<double>::infinity());
    world.column<HardeningModulus>().values()[slot] = m.hardening_modulus;
  }
}

}  // namespace pulvis::space
