#include "scenes/results/plane_parts.hpp"

#include <cmath>
#include <limits>

#include "components/body.hpp"
#include "components/cell.hpp"
#include "components/contact.hpp"
#include "components/observed.hpp"
#include "components/servo.hpp"
#include "engine/access.hpp"
#include "engine/portable_math.hpp"
#include "scenes/results/history_series.hpp"
#include "scenes/results/observed_results.hpp"
#include "scenes/results/particle_tags.hpp"
#include "scenes/results/plane_values.hpp"
#include "scenes/tools/die_relief.hpp"
#include "systems/tools/relief_kernel.hpp"

namespace pulvis {

namespace {

// Calls visit(slot row offset in `Entity` rows, lane, shape) for every particle by number.
template <class Entity, class Visit>
void for_each_particle(const World& world, const Visit& visit) {
  const Bodies& bodies = world.resource<Bodies>();
  const Table& table = const_cast<World&>(world).table<Entity>();
  for (const int slot : bodies.slot_of_number)
    visit(static_cast<std::size_t>(table.chunk_begin[static_cast<std::size_t>(slot / lane_count)]),
          slot % lane_count, bodies.shape_of_slot(slot));
}

template <class C>
std::vector<double> node_values(const World& world) {
  std::vector<double> out;
  for_each_particle<Node>(world, [&](std::size_t first, int lane, const Shape& shape) {
    const Lane* at = world.column<C>().lanes() + first * C::count;
    for (std::size_t i = 0; i < shape.nodes.size() * C::count; ++i) out.push_back(at[i][lane]);
  });
  return out;
}

std::vector<FieldInfo> fields_of(const Scene& scene, const World& world) {
  std::vector<FieldInfo> fields{
      {"position", "m", "of the node", FieldPlace::node, 2},
      {"velocity", "m/s", "of the node, half a step later", FieldPlace::node, 2},
      {"effective_stress", "Pa", "von Mises, mean of the Gauss points", FieldPlace::cell, 1},
      {"pressure", "Pa", "minus the mean stress; compression > 0", FieldPlace::cell, 1},
      {"stress", "Pa", "Cauchy: xx yy zz xy", FieldPlace::cell, 4}};
  if (is_plastic_plane(world))
    fields.push_back(
        {"plastic_strain", "-", "accumulated, mean of the Gauss points", FieldPlace::cell, 1});
  if (scene.cell)
    fields.push_back(
        {"cell", "m", "corner, first and second vector of the periodic cell", FieldPlace::list, 2});
  for (const FieldInfo& observed : observed_fields(scene)) fields.push_back(observed);
  return fields;
}

}  // namespace

PlaneParts::PlaneParts(const Scene& scene, const World& world)
    : world_(world),
      cell_(die_cell(scene)),
      yield_stress_(common_yield_stress(scene)),
      tags_(particle_tags(scene, world)),
      outlines_(scene, world, node_values<Position<TwoD>>(world)),
      fields_(fields_of(scene, world)) {
  for_each_particle<Node>(world, [&](std::size_t, int, const Shape& shape) {
    particle_area_ += shape.area;
    elements_ += shape.elements();
  });
}

std::vector<FieldInfo> PlaneParts::fields() const { return fields_; }

std::vector<FieldInfo> PlaneParts::tool_fields() const {
  return outlines_.empty() ? std::vector<FieldInfo>{} : std::vector{ToolOutlines::field()};
}

RunMesh PlaneParts::mesh() const {
  RunMesh mesh;
  std::size_t nodes = 0;
  for_each_particle<Node>(
      world_, [&](std::size_t, int, const Shape& shape) { nodes += shape.nodes.size(); });
  const auto cells = static_cast<std::size_t>(elements_);
  mesh.quads.reserve(4 * cells);
  mesh.cell_particle.reserve(cells);
  mesh.node_particle.reserve(nodes);
  std::int32_t particle = 0, first_node = 0;
  for_each_particle<Node>(world_, [&](std::size_t, int, const Shape& shape) {
    for (const auto& quad : shape.quads) {
      for (const Row<Node> n : quad) mesh.quads.push_back(first_node + n.value);
      mesh.cell_particle.push_back(particle);
    }
    mesh.node_particle.insert(mesh.node_particle.end(), shape.nodes.size(), particle);
    first_node += static_cast<std::int32_t>(shape.nodes.size());
    particle += 1;
  });
  mesh.reference = node_values<Position<TwoD>>(world_);
  mesh.tags = tags_;
  mesh.tools = outlines_.lines();
  return mesh;
}

namespace {
bool has_servo(const World& world, int tool) {
  return world.has<ToolServos>() &&
         std::ranges::any_of(world.resource<ToolServos>().servos,
                             [&](const ToolServos::Servo& servo) { return servo.tool == tool; });
}
}  // namespace

void PlaneParts::append_positions(std::vector<double>& row) const {
  if (!world_.has_table<Tool>()) return;
  const auto& position = world_.column<ToolPosition>();
  const auto& force = world_.column<ToolForce>();
  for (std::size_t t = 0; t < position.table.rows; ++t) {
    const double* at = position.values() + tool_axes * t;
    const double* borne = force.values() + tool_axes * t;
    row.insert(row.end(), {at[0], at[1], borne[0], borne[1]});
    if (has_servo(world_, static_cast<int>(t)))
      row.push_back(world_.column<ServoForce>().values()[2 * t]);
  }
}

namespace {
double die_area(const World& world, const DieCell& cell) {
  const double* at = world.column<ToolPosition>().values();
  constexpr int n = tool_axes;
  return kernels::die_area({at[n * cell.left], at[n * cell.right], at[n * cell.top + 1],
                            at[n * cell.bottom], at[n * cell.bottom + 1]},
                           relief_of(world, cell.bottom));
}
}  // namespace

Vec2 PlaneParts::die_size() const {
  const auto at = [&](int tool, int k) {
    return world_.column<ToolPosition>().values()[static_cast<std::size_t>(tool_axes * tool + k)];
  };
  return {at(cell_->right, 0) - at(cell_->left, 0), at(cell_->top, 1) - at(cell_->bottom, 1)};
}

void PlaneParts::append_density(std::vector<double>& row) const {
  if (!cell_) return;
  const auto force = [&](int tool, int k) {
    return world_.column<ToolForce>().values()[static_cast<std::size_t>(tool_axes * tool + k)];
  };
  const Vec2 size = die_size(), face = size * world_.resource<Bodies>().thickness;
  const double top = force(cell_->top, 1), bottom = -force(cell_->bottom, 1);
  const double left = -force(cell_->left, 0), right = force(cell_->right, 0);
  row.push_back(particle_area_ / die_area(world_, *cell_));
  if (yield_stress_) {
    row.push_back(0.5 * (top + bottom) / face.x() / *yield_stress_);
    row.push_back(0.5 * (right + left) / face.y() / *yield_stress_);
  }
  row.insert(row.end(), {top / face.x(), bottom / face.x(), left / face.y(), right / face.y()});
  row.push_back(top > 0 ? bottom / top : std::numeric_limits<double>::quiet_NaN());
}

void PlaneParts::append_cell(const Energies& e, std::vector<double>& row) const {
  const auto append = [&](double width, double height, const MixedControl& control) {
    row.insert(row.end(), {width, height});
    row.insert(row.end(), control.strain.begin(), control.strain.end());
    row.push_back(control.rotation);
    row.insert(row.end(), control.stress.begin(), control.stress.end());
    const double volume = enclosed_area() * world_.resource<Bodies>().thickness;
    row.push_back((e.elastic + e.hourglass + e.contact + e.bonds) / volume);
    row.push_back((e.plastic + e.friction + e.damping + e.bulk_damping + e.fracture) / volume);
  };
  if (world_.has<PeriodicCell>()) {
    const auto& cell = world_.resource<PeriodicCell>();
    const auto& h = cell.vectors.t;
    row.push_back(particle_area_ / cell.area());
    append(portable::hypot(h[0], h[2]), portable::hypot(h[1], h[3]), cell.control);
  } else if (world_.has<DrivenWalls>()) {
    append(die_size().x(), die_size().y(), world_.resource<DrivenWalls>().control);
  }
}

// m^2, of the enclosure of the powder; 0: there is none.
double PlaneParts::enclosed_area() const {
  if (world_.has<PeriodicCell>()) return world_.resource<PeriodicCell>().area();
  return cell_ ? die_area(world_, *cell_) : 0;
}

void PlaneParts::append_tools(const Energies& energies, std::vector<double>& row) const {
  append_positions(row);
  append_density(row);
  append_cell(energies, row);
}

void PlaneParts::append_contacts(std::vector<double>& row) const {
  ContactQuality now;
  if (world_.has<ContactQuality>()) now = world_.resource<ContactQuality>();
  row.push_back(now.overlap / particle_area_);
  row.push_back(now.force > 0 ? now.narrow_force / now.force : 0);
}

void PlaneParts::append_observed(std::vector<double>& row) const {
  append_observed_sample(world_, enclosed_area(), row);
}

void PlaneParts::append_frame(Fields& fields) const {
  if (world_.has<PeriodicCell>()) {
    const auto& cell = world_.resource<PeriodicCell>();
    const Point corner = cell.corner_now();
    const auto& h = cell.vectors.t;
    fields.push_back({corner[0], corner[1], h[0], h[2], h[1], h[3]});
  }
  append_observed_frame(world_, fields);
}

void PlaneParts::append_tool_frame(Fields& fields) const {
  if (!outlines_.empty()) fields.push_back(outlines_.points(world_));
}

double PlaneParts::volume() const { return particle_area_ * world_.resource<Bodies>().thickness; }

std::vector<double> PlaneParts::momentum() const {
  std::vector<double> sum(3);
  const double thickness = world_.resource<Bodies>().thickness;
  std::size_t i = 0;
  for_each_particle<Node>(world_, [&](std::size_t first, int lane, const Shape& shape) {
    const int slot = world_.resource<Bodies>().slot_of_number[i++];
    const double density = world_.column<Density>().values()[static_cast<std::size_t>(slot)];
    const Lane* x = world_.column<Position<TwoD>>().lanes() + 2 * first;
    const Lane* v = world_.column<Velocity<TwoD>>().lanes() + 2 * first;
    for (std::size_t n = 0; n < shape.nodes.size(); ++n) {
      const double mass = density * thickness * shape.nodal_area[n];
      const double vx = v[2 * n][lane], vy = v[2 * n + 1][lane];
      sum[0] += mass * vx;
      sum[1] += mass * vy;
      sum[2] += mass * (x[2 * n][lane] * vy - x[2 * n + 1][lane] * vx);
    }
  });
  return sum;
}

}  // namespace pulvis
