#include "scenes/space/results/space_parts.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "components/body.hpp"
#include "components/contact.hpp"
#include "components/observed.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "components/space/shape.hpp"
#include "engine/access.hpp"
#include "scenes/space/results/die_wall.hpp"
#include "scenes/space/results/observed_density.hpp"
#include "scenes/space/results/observed_network.hpp"
#include "scenes/space/results/observed_stress.hpp"
#include "scenes/space/results/space_series.hpp"
#include "scenes/space/results/space_tags.hpp"
#include "scenes/space/results/space_values.hpp"
#include "scenes/space/results/tool_sheets.hpp"
#include "scenes/space/results/visit_particles.hpp"
#include "scenes/space/tools/die_room.hpp"
#include "scenes/space/tools/powder.hpp"
#include "scenes/spec/space_scene.hpp"
#include "scenes/spec/yield.hpp"

namespace pulvis::space {
namespace {

template <class C>
std::vector<double> values_of_nodes(const World& world) {
  std::vector<double> out;
  visit_particles<Node>(world, [&](std::size_t first, int lane, const Shape& shape) {
    const Lane* at = world.column<C>().lanes() + first * C::count;
    for (std::size_t i = 0; i < shape.nodes.size() * C::count; ++i) out.push_back(at[i][lane]);
  });
  return out;
}

Eigen::AlignedBox3d box_of_nodes(const World& world) {
  Eigen::AlignedBox3d box;
  const std::vector<double> nodes = values_of_nodes<Position<ThreeD>>(world);
  for (std::size_t i = 0; i < nodes.size(); i += 3) box.extend(Vec3(Vec3::Map(&nodes[i])));
  return box;
}

std::vector<FieldInfo> fields_in_space(const World& world) {
  std::vector<FieldInfo> fields{
      {"position", "m", "of the node", FieldPlace::node, 3},
      {"velocity", "m/s", "of the node, half a step later", FieldPlace::node, 3},
      {"effective_stress", "Pa", "von Mises, mean of the Gauss points", FieldPlace::cell, 1},
      {"pressure", "Pa", "minus the mean stress; compression > 0", FieldPlace::cell, 1},
      {"stress", "Pa", "Cauchy: xx yy zz xy yz zx", FieldPlace::cell, 6}};
  if (is_plastic(world))
    fields.push_back(
        {"plastic_strain", "-", "accumulated, mean of the Gauss points", FieldPlace::cell, 1});
  for (const auto& observed : {stress_fields(world), network_fields(world), density_fields(world)})
    fields.insert(fields.end(), observed.begin(), observed.end());
  return fields;
}

// Whether both other tools are in the die: nothing encloses the powder beyond its mouth.
template <class At>
bool encloses(const DieRoom& room, const At& at) {
  if (!room.mouth) return true;
  const auto above_die = [&](DieRoom::Side side) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += room.axis[k] *
             (at(room.tool[side], static_cast<int>(k)) - at(room.die, static_cast<int>(k)));
    return sum;
  };
  return above_die(DieRoom::bottom) < *room.mouth && above_die(DieRoom::top) <= *room.mouth;
}

class SpaceParts : public ResultParts {
 public:
  SpaceParts(const Scene& scene, const World& world)
      : world_(world),
        room_(die_room(scene)),
        yield_stress_(common_yield_stress(scene)),
        volume_(powder_of(world, scene).volume),
        tags_(particle_tags(scene, world)),
        sheets_(*scene.space, box_of_nodes(world)) {
    for (std::size_t t = 0; t < scene.space->tools.size(); ++t)
      has_servo_.push_back(is_servo_driven(scene, static_cast<int>(t)) ||
                           is_driven_through_a_spring(scene, static_cast<int>(t)));
    visit_particles<Node>(
        world, [&](std::size_t, int, const Shape& shape) { elements_ += shape.elements(); });
  }

  RunMesh mesh() const override {
    RunMesh mesh;
    std::int32_t particle = 0, first_node = 0;
    visit_particles<Node>(world_, [&](std::size_t, int, const Shape& shape) {
      for (const auto& hexahedron : shape.hexahedra) {
        for (const Row<Node> n : hexahedron) mesh.hexahedra.push_back(first_node + n.value);
        mesh.cell_particle.push_back(particle);
      }
      mesh.node_particle.insert(mesh.node_particle.end(), shape.nodes.size(), particle);
      first_node += static_cast<std::int32_t>(shape.nodes.size());
      particle += 1;
    });
    mesh.reference = values_of_nodes<Position<ThreeD>>(world_);
    mesh.tags = tags_;
    mesh.tool_faces = sheets_.faces();
    return mesh;
  }

  std::vector<FieldInfo> fields() const override { return fields_in_space(world_); }
  std::vector<FieldInfo> tool_fields() const override {
    if (sheets_.faces().names.empty()) return {};
    return {ToolSheets::field()};
  }

  void append_frame(Fields& fields) const override {
    append_stress_frame(world_, fields);
    append_network_frame(world_, fields);
    append_density_frame(world_, fields);
  }
  void append_tool_frame(Fields& fields) const override {
    if (sheets_.faces().names.empty()) return;
    fields.push_back(sheets_.points(
        {world_.column<ToolPosition>().values(), tool_axes * sheets_.faces().names.size()}));
  }

  void append_tools(const Energies&, std::vector<double>& row) const override {
    if (!world_.has_table<Tool>()) return;
    for (int t = 0; t < static_cast<int>(has_servo_.size()); ++t) {
      for (int k = 0; k < tool_axes; ++k) row.push_back(position(t, k));
      for (int k = 0; k < tool_axes; ++k) row.push_back(force(t, k));
      if (has_servo_[static_cast<std::size_t>(t)])
        row.push_back(world_.column<ServoForce>().values()[2 * t]);
    }
    if (room_) append_room(row);
  }

  void append_contacts(std::vector<double>& row) const override {
    ContactQuality now;
    if (world_.has<ContactQuality>()) now = world_.resource<ContactQuality>();
    row.push_back(now.force > 0 ? now.narrow_force / now.force : 0);
  }
  void append_observed(std::vector<double>& row) const override {
    if (room_) append_stress_sample(world_, volume_of_room(), row);
    append_network_sample(world_, row);
    append_density_sample(world_, row);
  }

  std::vector<double> momentum() const override {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    const Bodies& bodies = world_.resource<Bodies>();
    std::size_t number = 0;
    visit_particles<Node>(world_, [&](std::size_t first, int lane, const Shape& shape) {
      const int slot = bodies.slot_of_number[number++];
      const double density = world_.column<Density>().values()[static_cast<std::size_t>(slot)];
      const Lane* x = world_.column<Position<ThreeD>>().lanes() + 3 * first;
      const Lane* v = world_.column<Velocity<ThreeD>>().lanes() + 3 * first;
      for (std::size_t n = 0; n < shape.nodes.size(); ++n) {
        const Vec3 at(x[3 * n][lane], x[3 * n + 1][lane], x[3 * n + 2][lane]);
        const Vec3 p = density * shape.nodal_volume[n] *
                       Vec3(v[3 * n][lane], v[3 * n + 1][lane], v[3 * n + 2][lane]);
        linear += p;
        angular += at.cross(p);
      }
    });
    return {linear.x(), linear.y(), linear.z(), angular.x(), angular.y(), angular.z()};
  }

  double volume() const override { return volume_; }
  std::int64_t elements() const override { return elements_; }

 private:
  double position(int tool, int k) const {
    return world_.column<ToolPosition>().values()[tool_axes * tool + k];
  }
  double force(int tool, int k) const {
    return world_.column<ToolForce>().values()[tool_axes * tool + k];
  }
  // N, on the tool at a side, away from the powder.
  double push(DieRoom::Side side, const DieRoom::Vector& outward) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += force(room_->tool[side], static_cast<int>(k)) * outward[k];
    return sum;
  }

  // m^3; NaN if the tools do not enclose it.
  double volume_of_room() const {
    const auto at = [&](int tool, int k) { return position(tool, k); };
    return encloses(*room_, at) ? room_->volume(at) : std::numeric_limits<double>::quiet_NaN();
  }
  void append_room(std::vector<double>& row) const {
    const auto at = [&](int tool, int k) { return position(tool, k); };
    const DieRoom::Vector& axis = room_->axis;
    const bool box = room_->kind == DieRoom::Kind::box;
    const double top = push(DieRoom::top, axis), area = room_->area(at);
    const double bottom = push(DieRoom::bottom, {-axis[0], -axis[1], -axis[2]});
    row.push_back(volume_ / volume_of_room());
    const std::vector<double> radial = box ? wall_stresses(at) : std::vector{die_stress(at)};
    if (yield_stress_) {
      row.push_back(0.5 * (top + bottom) / area / *yield_stress_);
      const double all = std::accumulate(radial.begin(), radial.end(), 0.0);
      row.push_back(all / static_cast<double>(radial.size()) / *yield_stress_);
    }
    row.insert(row.end(), {top / area, bottom / area});
    row.insert(row.end(), radial.begin(), radial.end());
    row.push_back(top > 0 ? bottom / top : std::numeric_limits<double>::quiet_NaN());
  }

  template <class At>
  double die_stress(const At& at) const {
    const double wall = room_->wall(at);
    return wall > 0 ? normal_force_on_die(world_, room_->die, room_->axis) / wall : 0;
  }
  template <class At>
  std::vector<double> wall_stresses(const At& at) const {
    const double height = room_->height(at);
    const double across_x = room_->depth(at) * height, across_y = room_->width(at) * height;
    return {push(DieRoom::left, {-1, 0, 0}) / across_x, push(DieRoom::right, {1, 0, 0}) / across_x,
            push(DieRoom::front, {0, -1, 0}) / across_y, push(DieRoom::back, {0, 1, 0}) / across_y};
  }

  const World& world_;
  std::optional<DieRoom> room_;
  std::optional<double> yield_stress_;  // if all particles share one
  double volume_ = 0;
  std::int64_t elements_ = 0;
  std::vector<bool> has_servo_;
  std::vector<ParticleTag> tags_;
  ToolSheets sheets_;
};

}  // namespace

std::unique_ptr<ResultParts> result_parts(const Scene& scene, const World& world) {
  return std::make_unique<SpaceParts>(scene, world);
}

}  // namespace pulvis::space
