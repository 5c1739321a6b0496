#include "scenes/body_columns.hpp"

#include <algorithm>
#include <limits>

#include "components/body.hpp"
#include "components/inertance.hpp"
#include "components/run_state.hpp"
#include "components/space/formulation.hpp"
#include "engine/chunk_lane.hpp"
#include "engine/entry.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {
namespace {

template <class Layout, class Count>
std::vector<std::int32_t> rows_by_chunk(const Layout& layout, const Count& count) {
  std::vector<std::int32_t> rows;
  for (int c = 0; c < layout.bodies.chunks(); ++c)
    rows.push_back(static_cast<std::int32_t>(count(shape_of(layout, c * lane_count))));
  return rows;
}

template <class F>
void add_quad_columns(World& world, const Needs& needs) {
  world.add<DeviatoricStress<TwoD, F::points>>();
  world.add<MeanStress<F::volumes>>();
  if (F::stabilised) {
    world.add<HourglassStress>();
    world.add<MinCorner>();
    world.add<HourglassEnergy>();
  }
  if (!needs.plastic) return;
  world.add<IsochoricScale<F::points>>();
  world.add<CpInverse<TwoD, F::points>>();
  world.add<PlasticStrain<F::points>>();
  if (F::stabilised) {
    world.add<PlasticHourglass<TwoD>>();
    world.add<HourglassWork>();
  }
}

template <class F>
void add_hexahedron_columns(World& world, const Needs& needs) {
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

template <class D>
void add_particle_columns(World& world, const Needs& needs) {
  world.add<ShearModulus>();
  world.add<BulkModulus>();
  world.add<Density>();
  world.add<MinJacobian>();
  world.add<WorstElement>();
  world.add<StableTimeStep>();
  world.add<KineticEnergy>();
  world.add<ElasticEnergy>();
  if (needs.bulk_damping) {
    world.add<DampingForce<D>>();
    world.add<MassDamping>();
    world.add<StiffnessDamping>();
    world.add<DampingWork>();
  }
  if (!needs.plastic) return;
  world.add<YieldStress>();
  world.add<HardeningModulus>();
  world.add<PlasticWork>();
  world.add<WorkBeyondHardening>();
  if (needs.flow_laws) world.add<ReturnResidual>();
}

template <class D, class Layout>
void add_tables(World& world, const Layout& layout) {
  world.add_table<Node>(rows_by_chunk(layout, [](const auto& s) { return s.nodes.size(); }));
  world.add_table<Element>(rows_by_chunk(layout, [](const auto& s) { return s.elements(); }));
  world.add_table<Particle>(rows_by_chunk(layout, [](const auto&) { return 1; }));
  world.add<Position<D>>();
  world.add<Velocity<D>>();
  world.add<InternalForce<D>>();
}

}  // namespace

void add_body_columns(World& world, const Layout& layout, const Needs& needs) {
  add_tables<TwoD>(world, layout);
  with_formulation(needs.formulation, [&]<class F>(F) { add_quad_columns<F>(world, needs); });
  add_particle_columns<TwoD>(world, needs);
}

void add_body_columns(World& world, const space::Layout& layout, const Needs& needs) {
  add_tables<ThreeD>(world, layout);
  space::with_hexahedra(needs.formulation,
                        [&]<class F>(F) { add_hexahedron_columns<F>(world, needs); });
  add_particle_columns<ThreeD>(world, needs);
}

void fill_bodies(World& world, const Layout& layout) {
  auto& x = world.column<Position<TwoD>>();
  auto& v = world.column<Velocity<TwoD>>();
  layout.bodies.for_own_lanes([&](int own) {
    const auto slot = static_cast<std::size_t>(own);
    const Chunk chunk{static_cast<std::int32_t>(slot / lane_count)};
    const int lane = static_cast<int>(slot % lane_count);
    const Placed* placed = layout.placed[slot];
    const Shape& shape = layout.bodies.shape_of_chunk(chunk);
    const auto first =
        static_cast<std::size_t>(x.table.chunk_begin[static_cast<std::size_t>(chunk.index)]);
    const std::vector<Vec2> arms = turned_nodes(shape, placed ? placed->turn : 0);
    for (std::size_t n = 0; n < arms.size(); ++n) {
      const Vec2& arm = arms[n];
      Lane* at = x.lanes() + 2 * (first + n);
      Lane* rate = v.lanes() + 2 * (first + n);
      const Vec2 where = placed ? Vec2(in_plane(placed->body->position) + arm) : arm;
      at[0][lane] = where.x();
      at[1][lane] = where.y();
      if (!placed) continue;
      const double omega = placed->body->angular_velocity.z();
      rate[0][lane] = placed->body->velocity.x() - omega * arm.y();
      rate[1][lane] = placed->body->velocity.y() + omega * arm.x();
    }
  });
}

void fill_bodies(World& world, const space::Layout& layout) {
  auto& x = world.column<Position<ThreeD>>();
  auto& v = world.column<Velocity<ThreeD>>();
  layout.bodies.for_own_lanes([&](int slot) {
    const auto& at = entry(layout.placed, slot);
    const ChunkLane where(slot);
    const space::Shape& shape = shape_of(layout, slot);
    const Eigen::Matrix3d turn = at ? at->turn.toRotationMatrix() : Eigen::Matrix3d::Identity();
    Lane* node_x = x.lanes() + 3 * entry(x.table.chunk_begin, where.chunk.index);
    Lane* node_v = v.lanes() + 3 * entry(v.table.chunk_begin, where.chunk.index);
    for (const space::Point& p : shape.nodes) {
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

void add_inerters(World& world, const ContactRules& rules) {
  world.add<Inertance>();
  auto& inertance = world.column<Inertance>();
  std::fill_n(inertance.values(), inertance.bytes() / sizeof(double), rules.inertance);
}

void fill_materials(World& world, const Scene& scene, const Bodies& bodies) {
  for (std::size_t slot = 0; slot < bodies.slots.size(); ++slot) {
    const MaterialSpec& m = scene.materials[static_cast<std::size_t>(bodies.slots[slot].material)];
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

void add_flow_laws(World& world, const Scene& scene, const Needs& needs) {
  if (!needs.flow_laws) return;
  FlowLaws laws;
  for (const MaterialSpec& m : scene.materials)
    laws.of_material.push_back(m.flow ? *m.flow : FlowLaw{});
  world.emplace<FlowLaws>(std::move(laws));
}

void add_run_state(World& world, const Scene& scene) {
  Clock& clock = world.emplace<Clock>();
  clock.safety = scene.time.safety;
  for (const StageSpec& stage : scene.stages) clock.end += stage.duration;
  world.emplace<Totals>();
}

}  // namespace pulvis
