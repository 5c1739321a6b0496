// Momentum of all nodes.
#include <Eigen/Geometry>

#include "components/body.hpp"
#include "components/shape.hpp"
#include "scenes/results/observables/result_rows.hpp"
#include "scenes/results/parts/visit_particles.hpp"

namespace pulvis {
namespace {

struct Momentum {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(),
                  angular = Eigen::Vector3d::Zero();  // kg m/s; kg m^2/s, about the origin
};

double density_of_particle(const World& world, std::size_t number) {
  const int slot = world.resource<Bodies>().slot_of_number[number];
  return world.column<Density>().values()[static_cast<std::size_t>(slot)];
}

Momentum momentum_in_the_plane(const Observation& now) {
  const World& world = now.world;
  const double thickness = world.resource<Bodies>().thickness;
  Momentum sum;
  std::size_t number = 0;
  visit_particles<TwoD>(world, [&](std::size_t first, int lane, const Shape& shape) {
    const double density = density_of_particle(world, number++);
    const Lane* x = world.column<Position<TwoD>>().lanes() + 2 * first;
    const Lane* v = world.column<Velocity<TwoD>>().lanes() + 2 * first;
    for (std::size_t n = 0; n < shape.nodes.size(); ++n) {
      const double mass = density * thickness * shape.nodal_area[n];
      const double vx = v[2 * n][lane], vy = v[2 * n + 1][lane];
      sum.linear.x() += mass * vx;
      sum.linear.y() += mass * vy;
      sum.angular.z() += mass * (x[2 * n][lane] * vy - x[2 * n + 1][lane] * vx);
    }
  });
  return sum;
}

Momentum momentum_in_space(const Observation& now) {
  const World& world = now.world;
  Momentum sum;
  std::size_t number = 0;
  visit_particles<ThreeD>(world, [&](std::size_t first, int lane, const space::Shape& shape) {
    const double density = density_of_particle(world, number++);
    const Lane* x = world.column<Position<ThreeD>>().lanes() + 3 * first;
    const Lane* v = world.column<Velocity<ThreeD>>().lanes() + 3 * first;
    for (std::size_t n = 0; n < shape.nodes.size(); ++n) {
      const Eigen::Vector3d at(x[3 * n][lane], x[3 * n + 1][lane], x[3 * n + 2][lane]);
      const Eigen::Vector3d p =
          density * shape.nodal_volume[n] *
          Eigen::Vector3d(v[3 * n][lane], v[3 * n + 1][lane], v[3 * n + 2][lane]);
      sum.linear += p;
      sum.angular += at.cross(p);
    }
  });
  return sum;
}

}  // namespace

void add_momentum(const Scene& scene, Observables& all) {
  const bool space = scene.in_space();
  const auto linear = [](int axis) { return [axis](const Momentum& m) { return m.linear[axis]; }; };
  const auto angular = [](int axis) {
    return [axis](const Momentum& m) { return m.angular[axis]; };
  };
  const char* of_nodes = "of all nodes";
  const char* about_origin = "of all nodes, about the origin";
  all.add(
      space ? momentum_in_space : momentum_in_the_plane,
      {{"momentum/x", "kg m/s", "momentum $p_x$", of_nodes, linear(0)},
       {"momentum/y", "kg m/s", "momentum $p_y$", of_nodes, linear(1)},
       {"momentum/z", "kg m/s", "momentum $p_z$", of_nodes, linear(2), space},
       {"momentum/angular", "kg m^2/s", "angular momentum $L$", about_origin, angular(2), !space},
       {"momentum/angular_x", "kg m^2/s", "angular momentum $L_x$", about_origin, angular(0),
        space},
       {"momentum/angular_y", "kg m^2/s", "angular momentum $L_y$", about_origin, angular(1),
        space},
       {"momentum/angular_z", "kg m^2/s", "angular momentum $L_z$", about_origin, angular(2),
        space}});
}

}  // namespace pulvis
