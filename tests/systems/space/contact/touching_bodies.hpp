// A world of particles in three dimensions with contact alone: nodes are moved by hand, and contact forces looked at.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <numeric>
#include <vector>

#include "components/body.hpp"
#include "components/space/contact.hpp"
#include "engine/system.hpp"
#include "scenes/meshes/hexahedra/mesh.hpp"
#include "scenes/needs.hpp"
#include "scenes/solid_contact_columns.hpp"
#include "scenes/spec/scene.hpp"
#include "systems/contact/systems.hpp"
#include "systems/space/contact/systems.hpp"
#include "systems/space/tools/systems.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis::space {

inline ParticleSpec sphere_of(double diameter, int divisions = 4, int rings = 4) {
  ParticleSpec spec;
  spec.shape = SphereShape{diameter};
  spec.hex_mesh = {divisions, rings};
  return spec;
}

class TouchingBodies {
 public:
  Scene scene;
  std::vector<BodySpec> bodies;
  World world;

  // Of the shape that BodySpec::particle counts. `change`: of the scene, before there is a world.
  TouchingBodies(std::vector<Shape> shapes, std::vector<BodySpec> placed,
                 const std::function<void(Scene&)>& change = {})
      : bodies(std::move(placed)) {
    scene.dimension = 3;
    scene.materials = {{"steel", 7850, 200e9, 0.3, {}, 0, {}, {}}};
    if (change) change(scene);
    lay_out(shapes);
    world.emplace<Shapes>().list = std::move(shapes);
    add_tools();
    add_contact(world, scene, needs_of(scene, bodies.size()));
    place();
    world.emplace<Totals>();
    world.emplace<Clock>();
  }

  const Shape& shape(int body = 0) const {
    const auto particle = static_cast<std::size_t>(bodies[static_cast<std::size_t>(body)].particle);
    return world.resource<Shapes>().list[particle];
  }
  int surface_nodes(int body) const { return shape(body).boundary_nodes; }
  double& node(int body, int number, int k) { return at<Position<ThreeD>>(body, number, k); }
  double& velocity(int body, int number, int k) { return at<Velocity<ThreeD>>(body, number, k); }
  Vec3 position_of(int body, int number) {
    return {node(body, number, 0), node(body, number, 1), node(body, number, 2)};
  }
  Vec3 velocity_of(int body, int number) {
    return {velocity(body, number, 0), velocity(body, number, 1), velocity(body, number, 2)};
  }
  Vec3 force_on(int body, int number) {
    const auto row = lane_row<ContactForce<ThreeD>>(body, number);
    return {row[0][lane(body)], row[1][lane(body)], row[2][lane(body)]};
  }
  Vec3 force_on(int body) {
    Vec3 sum = Vec3::Zero();
    for (int n = 0; n < surface_nodes(body); ++n) sum += force_on(body, n);
    return sum;
  }
  Vec3 moment_on(int body) {
    Vec3 sum = Vec3::Zero();
    for (int n = 0; n < surface_nodes(body); ++n)
      sum += position_of(body, n).cross(force_on(body, n));
    return sum;
  }
  double power_on(int body) {
    double sum = 0;
    for (int n = 0; n < surface_nodes(body); ++n)
      sum += velocity_of(body, n).dot(force_on(body, n));
    return sum;
  }
  // Every node of a body: where it is now, and how fast.
  void move(int body, const std::function<Vec3(const Vec3&)>& to) {
    for (int n = 0; n < static_cast<int>(shape(body).nodes.size()); ++n) {
      const Vec3 x = to(position_of(body, n));
      for (int k = 0; k < 3; ++k) node(body, n, k) = x[k];
    }
  }
  void set_velocity(int body, const std::function<Vec3(const Vec3&)>& of) {
    for (int n = 0; n < static_cast<int>(shape(body).nodes.size()); ++n) {
      const Vec3 v = of(position_of(body, n));
      for (int k = 0; k < 3; ++k) velocity(body, n, k) = v[k];
    }
  }

  // Contact at the present places.
  void update(bool anew = true) {
    if (anew)
      world.resource<ContactIndex>().motion_at_bin = -1;
    else
      wake();
    look();
  }
  // All bodies fly on for a step; points of contact that rest may go on resting.
  void fly(double dt) {
    Clock& clock = world.resource<Clock>();
    clock.dt_before = dt;
    double fastest = 0;
    for (int body = 0; body < static_cast<int>(bodies.size()); ++body)
      for (int n = 0; n < static_cast<int>(shape(body).nodes.size()); ++n) {
        fastest = std::max(fastest, velocity_of(body, n).norm());
        for (int k = 0; k < 3; ++k) node(body, n, k) += dt * velocity(body, n, k);
      }
    clock.relative_motion += 2 * fastest * dt;
    look();
  }
  // Of the points of contact between particles, in the last step.
  int projections() const {
    int sum = 0;
    for (const BlockSums& block : world.resource<ContactSums<Contact>>().blocks)
      sum += block.projections;
    return sum;
  }
  // As at the start of a run, after an update.
  void bond() {
    if (world.has<BondOffset<FaceContact>>()) run<initial_bonds>("initial_bonds");
    if (world.has<BondOffset<FaceToolContact>>()) run<initial_tool_bonds>("initial_tool_bonds");
  }
  const BondTotals& bonds() const { return world.resource<BondTotals>(); }
  // J, stored in contacts and bonds.
  double energy() const {
    const double contact = world.resource<Totals>().contact_energy;
    return world.has<BondTotals>() ? contact + bonds().energy : contact;
  }
  // J, of the springs that keep nodes near the smooth surface.
  double energy_of_node_springs() {
    const auto& all = world.column<ElasticEnergy>();
    double* values = world.column<ElasticEnergy>().values();
    std::fill_n(values, all.table.rows * lane_count, 0.0);
    run<node_spring_energy>("node_spring_energy");
    return std::accumulate(values, values + all.table.rows * lane_count, 0.0);
  }
  // Largest distance of a surface node of any particle, as the system finds it.
  double largest_node_distance() {
    run<node_distance>("node_distance");
    const auto& all = world.column<NodeDistance>();
    const double* values = all.values();
    return *std::max_element(values, values + all.table.rows * lane_count);
  }
  template <class S>
  void run(const char* name) {
    const System system = make_system<S>(world, name);
    if (!system.by_chunk) return system.run(Chunk{});
    for (int c = 0; c < world.chunks(); ++c) system.run(Chunk{c});
  }

 private:
  void look() {
    const bool pairs = world.has<ContactPair<FaceContact>>();
    const bool tools = world.has<ContactPair<FaceToolContact>>();
    run<contact_surface>("contact_surface");
    run<skin_check<ThreeD>>("skin_check");
    if (pairs) run<bin_faces>("bin_faces");
    if (tools) run<bin_tool_faces>("bin_tool_faces");
    if (pairs) run<face_contact>("face_contact");
    if (tools) run<tool_contact>("tool_contact");
    run<pulvis::contact_totals>("contact_totals");
    if (world.has<BondTotals>()) run<pulvis::bond_totals>("bond_totals");
    run<contact_force>("contact_force");
    if (tools) run<tool_reaction<ThreeD>>("tool_reaction");
  }
  int slot(int body) const {
    return world.resource<Bodies>().slot_of_number[static_cast<std::size_t>(body)];
  }
  int chunk(int body) const { return slot(body) / lane_count; }
  int lane(int body) const { return slot(body) % lane_count; }
  template <class C>
  Lane* lane_row(int body, int number) {
    auto& column = world.column<C>();
    return column.lanes() +
           3 * (static_cast<std::size_t>(
                    column.table.chunk_begin[static_cast<std::size_t>(chunk(body))]) +
                static_cast<std::size_t>(number));
  }
  template <class C>
  double& at(int body, int number, int k) {
    return lane_row<C>(body, number)[k][lane(body)];
  }
  void wake() {
    if (world.has<ReactivationDistance<FaceContact>>()) wake_rows<FaceContact>();
    if (world.has<ReactivationDistance<FaceToolContact>>()) wake_rows<FaceToolContact>();
  }
  template <class At>
  void wake_rows() {
    auto& column = world.column<ReactivationDistance<At>>();
    std::fill_n(column.values(), ReactivationDistance<At>::count * column.table.rows, 0.0);
  }
  void lay_out(const std::vector<Shape>& shapes) {
    Bodies& all = world.emplace<Bodies>();
    all.slot_of_number.assign(bodies.size(), Bodies::empty_slot);
    std::vector<std::int32_t> nodes;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (bodies[b].particle != static_cast<int>(s)) continue;
        all.slot_of_number[b] = static_cast<int>(all.slots.size());
        all.slots.push_back({static_cast<int>(b), static_cast<int>(s), 0, 0, 0});
      }
      while (all.slots.size() % lane_count != 0)
        all.slots.push_back({Bodies::empty_slot, static_cast<int>(s), 0, 0, 0});
      nodes.resize(all.slots.size() / lane_count,
                   static_cast<std::int32_t>(shapes[s].nodes.size()));
    }
    all.hold_all();
    const std::size_t lanes = all.slots.size();
    world.add_table<Node>(nodes);
    world.add<Position<ThreeD>>();
    world.add<Velocity<ThreeD>>();
    world.add_table<Particle>(std::vector<std::int32_t>(lanes / lane_count, 1));
    world.add<BulkModulus>();
    world.add<Density>();
    world.add<ElasticEnergy>();
    std::fill_n(world.column<BulkModulus>().values(), lanes, 200e9 / 3 / 0.4);
    std::fill_n(world.column<Density>().values(), lanes, 7850.0);
  }
  void add_tools() {
    const auto& tools = scene.tools;
    if (tools.empty()) return;
    world.add_table<Tool>(tools.size());
    world.add<ToolPosition>();
    world.add<ToolVelocity>();
    world.add<ToolNormal>();
    world.add<ToolForce>();
    for (std::size_t t = 0; t < tools.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        world.column<ToolNormal>().values()[3 * t + k] = tools[t].normal[static_cast<int>(k)];
        world.column<ToolPosition>().values()[3 * t + k] = tools[t].point[static_cast<int>(k)];
      }
  }
  // Slots where nobody stands stay at the origin.
  void place() {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const int body = static_cast<int>(b);
      for (int n = 0; n < static_cast<int>(shape(body).nodes.size()); ++n) {
        const Point& p = shape(body).nodes[static_cast<std::size_t>(n)];
        const Vec3 x = bodies[b].position + bodies[b].rotation * Vec3(p[0], p[1], p[2]);
        for (int k = 0; k < 3; ++k) node(body, n, k) = x[k];
      }
    }
  }
};

inline BodySpec body_at(const Vec3& position, const Rotation& rotation = Rotation::Identity()) {
  BodySpec body;
  body.position = position;
  body.rotation = rotation;
  return body;
}

}  // namespace pulvis::space
