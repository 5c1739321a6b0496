// Blocks of hexahedra for the tests of the bodies in three dimensions, and the systems that run on them.
#pragma once

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <functional>
#include <memory>
#include <numeric>

#include "components/body.hpp"
#include "components/run_state.hpp"
#include "scenes/body_columns.hpp"
#include "scenes/meshes/hexahedra/element_constants.hpp"
#include "systems/space/body/systems.hpp"
#include "tests/helpers/random_values.hpp"

namespace pulvis::space {

using pulvis::kernels::Random;
using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;
// Both element formulations, for typed tests.
using Formulations = testing::Types<OnePoint, EightPoint>;

// nx * ny * nz hexahedra of the unit cube, moved by `place`.
inline Shape block(std::array<int, 3> n, const std::function<Vector(const Vector&)>& place) {
  Shape shape;
  const auto row = [&](int i, int j, int k) {
    return Row<Node>(i + (n[0] + 1) * (j + (n[1] + 1) * k));
  };
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) {
        const Vector x = place({double(i) / n[0], double(j) / n[1], double(k) / n[2]});
        shape.nodes.push_back({x[0], x[1], x[2]});
      }
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        shape.hexahedra.push_back({row(i, j, k), row(i + 1, j, k), row(i + 1, j + 1, k),
                                   row(i, j + 1, k), row(i, j, k + 1), row(i + 1, j, k + 1),
                                   row(i + 1, j + 1, k + 1), row(i, j + 1, k + 1)});
  complete_elements(shape);
  return shape;
}

// Every node of the block, also those of its surface, somewhere near its place.
inline Shape distorted_block(std::array<int, 3> n, double by, std::uint64_t seed) {
  Random random(seed);
  return block(n, [&](const Vector& x) {
    Vector moved = x;
    for (int k = 0; k < 3; ++k) moved[k] += by / n[std::size_t(k)] * random.in(-1, 1);
    return moved;
  });
}

inline MaterialSpec material(double e, double nu, std::optional<double> yield = {}, double h = 0) {
  MaterialSpec m;
  m.name = "material";
  m.density = 1000;
  m.youngs_modulus = e;
  m.poissons_ratio = nu;
  m.yield_stress = yield;
  m.hardening_modulus = h;
  return m;
}

// Eight particles of one shape: lane 0 is looked at.
template <class F>
class Body {
 public:
  explicit Body(Shape shape, const MaterialSpec& m) {
    Scene scene;
    scene.dimension = 3;
    scene.materials = {m};
    scene.element.formulation = F::stabilised ? Formulation::one_point : Formulation::four_point;
    Layout layout;
    Bodies& bodies = layout.bodies;
    bodies.formulation = scene.element.formulation;
    bodies.slots.assign(lane_count, {0, 0, 0, 0, 0});
    for (int l = 0; l < lane_count; ++l) bodies.slots[std::size_t(l)].number = l;
    bodies.slot_of_number.resize(lane_count);
    std::iota(bodies.slot_of_number.begin(), bodies.slot_of_number.end(), 0);
    bodies.hold_all();
    layout.shapes.list.push_back(std::move(shape));
    const BodySpec spec;
    layout.placed.assign(lane_count, Placed{&spec});
    add_body_columns(world, layout, needs_of(scene, lane_count));
    fill_bodies(world, layout);
    fill_materials(world, scene, bodies);
    if (m.flow) {
      FlowLaws laws;
      laws.of_material.push_back(*m.flow);
      world.emplace<FlowLaws>(std::move(laws));
    }
    world.emplace<Bodies>(std::move(bodies));
    world.emplace<Shapes>(std::move(layout.shapes));
    world.emplace<Clock>().dt_before = 1;
  }

  template <class S>
  void run() {
    const detail::Opener opener{world};
    const S system = opener.open<S>();
    system(BusyChunk{Chunk{0}});
  }
  void find_forces() {
    if (world.has<YieldStress>())
      run<plastic_force<F>>();
    else
      run<elastic_force<F>>();
  }

  const Shape& shape() const { return world.resource<Shapes>().list[0]; }
  int nodes() const { return static_cast<int>(shape().nodes.size()); }
  template <class C>
  double& number(int row, int component = 0, int lane = 0) {
    return world.column<C>().lanes()[row * C::count + component][lane];
  }
  Vector position(int n) {
    return {number<Position<ThreeD>>(n, 0), number<Position<ThreeD>>(n, 1),
            number<Position<ThreeD>>(n, 2)};
  }
  void put(int n, const Vector& x) {
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < lane_count; ++l) number<Position<ThreeD>>(n, k, l) = x[k];
  }
  void place(const std::function<Vector(const Vector&)>& of_undeformed) {
    for (int n = 0; n < nodes(); ++n) {
      const Point& p = shape().nodes[std::size_t(n)];
      put(n, of_undeformed({p[0], p[1], p[2]}));
    }
  }
  Vector force(int n) {
    return {number<InternalForce<ThreeD>>(n, 0), number<InternalForce<ThreeD>>(n, 1),
            number<InternalForce<ThreeD>>(n, 2)};
  }
  double stored_energy() {
    run<elastic_energy<F>>();
    double sum = number<ElasticEnergy>(0);
    if constexpr (F::stabilised) {
      run<hourglass_energy>();
      sum += number<HourglassEnergy>(0);
      if (world.has<HourglassWork>()) sum -= number<HourglassWork>(0);
    }
    return sum;
  }
  Matrix cauchy(int e, int g = 0) {
    const auto s = [&](int k) { return number<DeviatoricStress<ThreeD, F::points>>(e, 5 * g + k); };
    Matrix m;
    m << s(0), s(2), s(4), s(2), s(1), s(3), s(4), s(3), -s(0) - s(1);
    return m + number<MeanStress<1>>(e) * Matrix::Identity();
  }

  World world;
};

}  // namespace pulvis::space
