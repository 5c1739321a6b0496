// Throughput of the 3D body systems on one core: stress, return mapping and forces of hexahedra, and the
// motion of their nodes. Items are hexahedra; `flowing`: all of them yield in every step.
//
//   ./build/release/bench/space_kernels
#include <benchmark/benchmark.h>

#include "components/body.hpp"
#include "components/run_state.hpp"
#include "components/space/formulation.hpp"
#include "scenes/body_columns.hpp"
#include "scenes/meshes/hexahedra/element_constants.hpp"
#include "systems/space/body/systems.hpp"

namespace pulvis::space {
namespace {

// A cube of n^3 hexahedra.
Shape cube(int n) {
  Shape shape;
  const auto row = [&](int i, int j, int k) { return Row<Node>(i + (n + 1) * (j + (n + 1) * k)); };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        shape.nodes.push_back({double(i) / n, double(j) / n, double(k) / n});
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        shape.hexahedra.push_back({row(i, j, k), row(i + 1, j, k), row(i + 1, j + 1, k),
                                   row(i, j + 1, k), row(i, j, k + 1), row(i + 1, j, k + 1),
                                   row(i + 1, j + 1, k + 1), row(i, j + 1, k + 1)});
  complete_elements(shape);
  return shape;
}

Scene scene_of(bool plastic) {
  Scene scene;
  scene.dimension = 3;
  MaterialSpec& m = scene.materials.emplace_back();
  m.density = 8930;
  m.youngs_modulus = 117e9;
  m.poissons_ratio = 0.35;
  if (plastic) m.yield_stress = 400e6;
  m.hardening_modulus = 100e6;
  return scene;
}

// `chunks` of eight cubes.
std::unique_ptr<World> cubes(const Scene& scene, Formulation formulation, int n, int chunks) {
  auto world = std::make_unique<World>();
  Layout layout;
  Bodies& bodies = layout.bodies;
  bodies.formulation = formulation;
  bodies.slots.resize(static_cast<std::size_t>(chunks * lane_count));
  bodies.hold_all();
  layout.shapes.list.push_back(cube(n));
  const BodySpec spec;
  layout.placed.assign(bodies.slots.size(), Placed{&spec});
  Needs needs = needs_of(scene, bodies.slots.size());
  needs.formulation = formulation;
  add_body_columns(*world, layout, needs);
  fill_bodies(*world, layout);
  fill_materials(*world, scene, bodies);
  world->emplace<Bodies>(std::move(bodies));
  world->emplace<Shapes>(std::move(layout.shapes));
  Clock& clock = world->emplace<Clock>();
  clock.dt = clock.dt_before = 1e-9;
  return world;
}

// Every node moves differently in x, y and z: strains of rate / (1/n) in every element, bent and twisted.
void set_off(World& world, double speed) {
  auto& v = world.column<Velocity<ThreeD>>();
  std::uint32_t random = 1;
  for (std::size_t i = 0; i < v.bytes() / sizeof(double); ++i) {
    random = random * 1664525 + 1013904223;
    v.values()[i] = speed * (random * 0x1p-31 - 1);
  }
}

template <class S>
S open(World& world) {
  return detail::Opener{world}.open<S>();
}

template <class F>
std::vector<double> plastic_strains(World& world) {
  const auto& eps = world.column<PlasticStrain<F::points>>();
  return {eps.values(), eps.values() + eps.bytes() / sizeof(double)};
}

// Fraction of points in the first chunk that yield, averaged over twenty steps back and forth.
double flowing_share(World& world, Formulation formulation, const auto& force) {
  const auto move = open<integrate<ThreeD>>(world);
  const auto strains = [&] {
    return with_hexahedra(formulation, [&]<class F>(F) { return plastic_strains<F>(world); });
  };
  Clock& clock = world.resource<Clock>();
  double grown = 0, all = 0;
  for (int at = 1; at <= 20; ++at) {
    const std::vector<double> before = strains();
    clock.dt = at % 20 < 10 ? 1e-9 : -1e-9;
    clock.dt_before = -clock.dt;
    force(BusyChunk{Chunk{0}});
    move(Chunk{0});
    const std::vector<double> after = strains();
    const std::size_t points =
        world.table<Element>().chunk_begin[1] * before.size() / world.table<Element>().rows;
    for (std::size_t i = 0; i < points; ++i) grown += after[i] > before[i];
    all += static_cast<double>(points);
  }
  return grown / all;
}

template <class ForceSystem>
void step(benchmark::State& state, Formulation formulation, bool plastic, double speed) {
  const int n = static_cast<int>(state.range(0)), chunks = static_cast<int>(state.range(1));
  const auto world = cubes(scene_of(plastic), formulation, n, chunks);
  const auto force = open<ForceSystem>(*world);
  const auto move = open<integrate<ThreeD>>(*world);
  set_off(*world, speed);
  // Back and forth, so that the mesh does not drift.
  int at = 0;
  for (auto unused : state) {
    (void)unused;
    world->resource<Clock>().dt = ++at % 20 < 10 ? 1e-9 : -1e-9;
    world->resource<Clock>().dt_before = -world->resource<Clock>().dt;
    for (int c = 0; c < chunks; ++c) {
      force(BusyChunk{Chunk{c}});
      move(Chunk{c});
    }
  }
  state.SetItemsProcessed(state.iterations() * n * n * n * lane_count * chunks);
  if (plastic) state.counters["flowing"] = flowing_share(*world, formulation, force);
}

constexpr double flowing = 1e6, resting = 1;  // m/s: strains of 1e-2 and of 1e-8 per step

void one_point_elastic(benchmark::State& state) {
  step<elastic_force<OnePoint>>(state, Formulation::one_point, false, flowing);
}
void one_point_below_yield(benchmark::State& state) {
  step<plastic_force<OnePoint>>(state, Formulation::one_point, true, resting);
}
void one_point_flowing(benchmark::State& state) {
  step<plastic_force<OnePoint>>(state, Formulation::one_point, true, flowing);
}
void eight_point_flowing(benchmark::State& state) {
  step<plastic_force<EightPoint>>(state, Formulation::four_point, true, flowing);
}

// Particles of 64 and 512 hexahedra that fit in cache; 512 in chunks that do not.
#define SIZES Args({4, 1})->Args({8, 1})->Args({8, 20})
BENCHMARK(one_point_elastic)->SIZES;
BENCHMARK(one_point_below_yield)->SIZES;
BENCHMARK(one_point_flowing)->SIZES;
BENCHMARK(eight_point_flowing)->SIZES;

}  // namespace
}  // namespace pulvis::space

BENCHMARK_MAIN();
