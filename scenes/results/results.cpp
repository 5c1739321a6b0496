#include "scenes/results/results.hpp"
#include "scenes/results/observed_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/body.hpp"
#include "components/bond.hpp"
#include "components/cell.hpp"
#include "components/contact.hpp"
#include "components/observed.hpp"
#include "components/servo.hpp"
#include "engine/access.hpp"
#include "engine/portable_math.hpp"
#include "scenes/results/bond_results.hpp"
#include "scenes/results/observe.hpp"
#include "scenes/results/particle_tags.hpp"
#include "scenes/tools/die_relief.hpp"
#include "systems/tools/relief_kernel.hpp"

namespace pulvis {

namespace {

// Sum over the particles in the order of their numbers; empty lanes do not count.
template <class C>
double total(const World& world) {
  const Bodies& bodies = world.resource<Bodies>();
  double sum = 0;
  for (const int slot : bodies.slot_of_number)
    sum += world.column<C>().values()[static_cast<std::size_t>(slot)];
  return sum;
}

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

struct CellStress {
  double xx = 0, yy = 0, zz = 0, xy = 0, effective = 0, pressure = 0;
};

// The element columns of whichever formulation the scene has.
struct ElementColumns {
  const Lane* deviator;
  const Lane* mean_stress;
  const Lane* plastic_strain;  // null: elastic
  int points, volumes;
};
template <class F>
ElementColumns columns_of(const World& world) {
  const bool plastic = world.has<PlasticStrain<F::points>>();
  return {world.column<DeviatoricStress<F::points>>().lanes(),
          world.column<MeanStress<F::volumes>>().lanes(),
          plastic ? world.column<PlasticStrain<F::points>>().lanes() : nullptr, F::points,
          F::volumes};
}
ElementColumns element_columns(const World& world) {
  return with_formulation(world.resource<Bodies>().formulation,
                          [&]<class F>(F) { return columns_of<F>(world); });
}

double mean_of(const Lane* values, int count, int lane) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += values[i][lane];
  return sum / count;
}

// Mean over the points of an element; the effective stress is the mean of theirs.
CellStress cell_stress(const ElementColumns& columns, std::size_t e, int lane) {
  CellStress c;
  const int points = columns.points;
  const Lane* s = columns.deviator + e * static_cast<std::size_t>(3 * points);
  for (int g = 0; g < points; ++g) {
    const double xx = s[3 * g][lane], yy = s[3 * g + 1][lane], xy = s[3 * g + 2][lane];
    const double zz = -(xx + yy);
    c.xx += xx / points;
    c.yy += yy / points;
    c.zz += zz / points;
    c.xy += xy / points;
    c.effective += std::sqrt(1.5 * (xx * xx + yy * yy + zz * zz + 2 * xy * xy)) / points;
  }
  const double mean = mean_of(columns.mean_stress + e * static_cast<std::size_t>(columns.volumes),
                              columns.volumes, lane);
  c.xx += mean;
  c.yy += mean;
  c.zz += mean;
  c.pressure = -mean;
  return c;
}

}  // namespace

Results::Results(const Scene& scene, const World& world)
    : world_(world),
      cell_(die_cell(scene)),
      yield_stress_(common_yield_stress(scene)),
      series_(history_series(scene)),
      tables_(bond_tables(scene)),
      tags_(particle_tags(scene, world)),
      outlines_(scene, world, node_values<Position>(world)),
      shear_(scene, world) {
  for_each_particle<Node>(world, [&](std::size_t, int, const Shape& shape) {
    particle_area_ += shape.area;
    elements_ += shape.elements();
    nodes_ += static_cast<std::int64_t>(shape.nodes.size());
  });
  const double modulus = *std::ranges::max_element(
      world.column<BulkModulus>().values(),
      world.column<BulkModulus>().values() + world.resource<Bodies>().slots.size());
  stiffness_energy_ = modulus * particle_area_ * scene.thickness;
  for (std::size_t i = 0; i < series_.size(); ++i) position_[series_[i].name] = i;

  fields_ = {{"position", "m", "of the node", FieldPlace::node, 2},
             {"velocity", "m/s", "of the node, half a step later", FieldPlace::node, 2},
             {"effective_stress", "Pa", "von Mises, mean of the Gauss points", FieldPlace::cell, 1},
             {"pressure", "Pa", "minus the mean stress; compression > 0", FieldPlace::cell, 1},
             {"stress", "Pa", "Cauchy: xx yy zz xy", FieldPlace::cell, 4}};
  if (element_columns(world).plastic_strain != nullptr)
    fields_.push_back(
        {"plastic_strain", "-", "accumulated, mean of the Gauss points", FieldPlace::cell, 1});
  if (scene.cell)
    fields_.push_back(
        {"cell", "m", "corner, first and second vector of the periodic cell", FieldPlace::list, 2});
  for (const FieldInfo& observed : observed_fields(scene)) fields_.push_back(observed);
  for (const FieldInfo& of_bonds : bond_fields(scene)) fields_.push_back(of_bonds);
  for (const FieldInfo& of_shear : ShearResults::fields(scene)) fields_.push_back(of_shear);
  if (!outlines_.empty()) fields_.push_back(ToolOutlines::field());
}

RunMesh Results::mesh() const {
  RunMesh mesh;
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
  mesh.reference = node_values<Position>(world_);
  mesh.tags = tags_;
  mesh.tools = outlines_.lines();
  return mesh;
}

void Results::take_energies() {
  const Totals& totals = world_.resource<Totals>();
  Energies& e = energies_;
  e.kinetic = total<KineticEnergy>(world_);
  e.elastic = total<ElasticEnergy>(world_);
  e.plastic = world_.has<PlasticWork>() ? total<PlasticWork>(world_) : 0;
  e.hourglass = world_.has<HourglassEnergy>() ? total<HourglassEnergy>(world_) : 0;
  e.contact = totals.contact_energy;
  e.friction = totals.friction_work;
  e.damping = totals.damping_work;
  e.bulk_damping = world_.has<DampingWork>() ? total<DampingWork>(world_) : 0;
  if (world_.has<BondTotals>()) {
    e.bonds = world_.resource<BondTotals>().energy;
    e.fracture = world_.resource<BondTotals>().fracture;
  }
  e.external = totals.external_work;
  const double all = e.kinetic + e.elastic + e.plastic + e.hourglass + e.contact + e.friction +
                     e.damping + e.bulk_damping + e.bonds + e.fracture;
  if (first_) initial_energy_ = all - e.external;  // a state to begin with has its own
  first_ = false;
  e.balance = all - e.external - initial_energy_;
  // "Not smaller" instead of "larger": a NaN must come through to the limits.
  if (!(std::abs(e.balance) <= worst_balance_)) worst_balance_ = std::abs(e.balance);
  largest_energy_ = std::max({largest_energy_, std::abs(e.external), std::abs(initial_energy_)});
  take_kinetic_ratio();
}

// Samples with hardly any internal energy do not count: nothing is quasi-static at first touch. Which these are is
// known in the end only, so all are kept that no other outdoes in both figures.
void Results::take_kinetic_ratio() {
  const double internal = energies_.internal();
  largest_internal_ = std::max(largest_internal_, internal);
  const double minimum = 0.01 * largest_internal_;
  std::erase_if(kinetic_ratios_, [&](const auto& sample) { return sample.second <= minimum; });
  if (internal <= minimum) return;
  const double ratio = energies_.kinetic / internal;
  const auto outdone_by = [](double r, double i) {
    return [=](const auto& sample) { return sample.first <= r && sample.second <= i; };
  };
  for (const auto& [r, i] : kinetic_ratios_)
    if (r >= ratio && i >= internal) return;
  std::erase_if(kinetic_ratios_, outdone_by(ratio, internal));
  kinetic_ratios_.emplace_back(ratio, internal);
}

void Results::take_peaks() {
  const auto take = [](double& peak, double value) {
    if (std::isfinite(value)) peak = std::max(peak, std::abs(value));
  };
  take(peaks_.elastic, energies_.elastic);
  take(peaks_.plastic, energies_.plastic);
  take(peaks_.hourglass, energies_.hourglass);
  take(peaks_.penetration, world_.resource<Totals>().worst_penetration);
}

double Results::kinetic_ratio() const {
  double worst = 0;
  for (const auto& [ratio, internal] : kinetic_ratios_)
    if (!(ratio <= worst)) worst = ratio;
  return worst;
}

namespace {
bool has_servo(const World& world, int tool) {
  return world.has<ToolServos>() &&
         std::ranges::any_of(world.resource<ToolServos>().servos,
                             [&](const ToolServos::Servo& servo) { return servo.tool == tool; });
}
}  // namespace

void Results::append_tools(std::vector<double>& row) const {
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

Vec2 Results::die_size() const {
  const auto at = [&](int tool, int k) {
    return world_.column<ToolPosition>().values()[static_cast<std::size_t>(tool_axes * tool + k)];
  };
  return {at(cell_->right, 0) - at(cell_->left, 0), at(cell_->top, 1) - at(cell_->bottom, 1)};
}

void Results::append_density(std::vector<double>& row) const {
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

void Results::append_cell(std::vector<double>& row) const {
  const auto append = [&](double width, double height, const MixedControl& control) {
    row.insert(row.end(), {width, height});
    row.insert(row.end(), control.strain.begin(), control.strain.end());
    row.push_back(control.rotation);
    row.insert(row.end(), control.stress.begin(), control.stress.end());
    const double volume = enclosed_area() * world_.resource<Bodies>().thickness;
    const Energies& e = energies_;
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

// m^2, of what is around the powder; 0: nothing is.
double Results::enclosed_area() const {
  if (world_.has<PeriodicCell>()) return world_.resource<PeriodicCell>().area();
  return cell_ ? die_area(world_, *cell_) : 0;
}

void Results::append_energies(std::vector<double>& row) const {
  const Energies& e = energies_;
  row.insert(row.end(), {e.kinetic, e.elastic, e.plastic});
  row.push_back(e.hourglass);
  row.insert(row.end(), {e.contact, e.friction, e.damping});
  if (world_.has<DampingWork>()) row.push_back(e.bulk_damping);
  if (world_.has<BondTotals>()) row.insert(row.end(), {e.bonds, e.fracture});
  row.insert(row.end(), {e.external, e.balance});
}

void Results::append_contacts(std::vector<double>& row) const {
  ContactQuality now;
  if (world_.has<ContactQuality>()) now = world_.resource<ContactQuality>();
  row.push_back(now.overlap / particle_area_);
  row.push_back(now.force > 0 ? now.narrow_force / now.force : 0);
  append_bond_sample(world_, row);
}

std::vector<double> Results::sample() {
  take_energies();
  take_peaks();
  std::vector<double> row;
  append_tools(row);
  append_density(row);
  append_cell(row);
  append_energies(row);
  const Totals& totals = world_.resource<Totals>();
  row.push_back(static_cast<double>(totals.touching));
  row.push_back(totals.worst_penetration);
  append_contacts(row);
  row.push_back(min_jacobian());
  row.push_back(world_.resource<Clock>().dt);
  append_observed_sample(world_, enclosed_area(), row);
  shear_.append_sample(energies_.plastic, row);
  last_ = row;
  return row;
}

std::vector<std::vector<double>> Results::frame() const {
  std::vector<std::vector<double>> fields{node_values<Position>(world_),
                                          node_values<Velocity>(world_)};
  const bool plastic = element_columns(world_).plastic_strain != nullptr;
  fields.resize(plastic ? 6 : 5);
  for_each_particle<Element>(world_, [&](std::size_t first, int lane, const Shape& shape) {
    const ElementColumns columns = element_columns(world_);
    for (std::size_t e = first; e < first + shape.quads.size(); ++e) {
      const CellStress c = cell_stress(columns, e, lane);
      fields[2].push_back(c.effective);
      fields[3].push_back(c.pressure);
      fields[4].insert(fields[4].end(), {c.xx, c.yy, c.zz, c.xy});
      if (!plastic) continue;
      const auto points = static_cast<std::size_t>(columns.points);
      fields[5].push_back(mean_of(columns.plastic_strain + e * points, columns.points, lane));
    }
  });
  if (world_.has<PeriodicCell>()) {
    const auto& cell = world_.resource<PeriodicCell>();
    const Point corner = cell.corner_now();
    const auto& h = cell.vectors.t;
    fields.push_back({corner[0], corner[1], h[0], h[2], h[1], h[3]});
  }
  append_observed_frame(world_, fields);
  append_bond_frame(world_, fields);
  shear_.append_frame(fields);
  if (!outlines_.empty()) fields.push_back(outlines_.points(world_));
  return fields;
}

double Results::value(const std::string& series) const { return last_.at(position_.at(series)); }

std::array<double, 3> Results::momentum() const {
  std::array<double, 3> sum{};
  const double thickness = world_.resource<Bodies>().thickness;
  std::size_t i = 0;
  for_each_particle<Node>(world_, [&](std::size_t first, int lane, const Shape& shape) {
    const int slot = world_.resource<Bodies>().slot_of_number[i++];
    const double density = world_.column<Density>().values()[static_cast<std::size_t>(slot)];
    const Lane* x = world_.column<Position>().lanes() + 2 * first;
    const Lane* v = world_.column<Velocity>().lanes() + 2 * first;
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

// The state that was just observed is the next step's to look at, if there is one.
double Results::min_jacobian() const {
  double minimum = world_.resource<Totals>().min_jacobian;
  for (const int slot : world_.resource<Bodies>().slot_of_number)
    minimum =
        std::min(minimum, world_.column<MinJacobian>().values()[static_cast<std::size_t>(slot)]);
  return minimum;
}

// The forces of a step are those at its ends: where surfaces meet within it, the balance is known to no more than
// its work. Twenty of them bring in enough to judge by.
double Results::energy_balance_error() const {
  constexpr double round_off = 1e-12, steps_of_a_touch = 20;
  const double unresolved = steps_of_a_touch * world_.resource<Totals>().largest_work;
  return worst_balance_ / std::max({largest_energy_, unresolved, round_off * stiffness_energy_});
}

}  // namespace pulvis
