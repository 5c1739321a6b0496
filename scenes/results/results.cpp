#include "scenes/results/results.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "components/body.hpp"
#include "components/bond.hpp"
#include "components/contact.hpp"
#include "components/space/contact.hpp"
#include "engine/portable_math.hpp"
#include "scenes/results/bond_results.hpp"
#include "scenes/results/particle_tags.hpp"
#include "scenes/results/plane_parts.hpp"
#include "scenes/results/solids/space_parts.hpp"

namespace pulvis {

namespace {

// Sum over the particles in the order of their numbers; empty lanes are skipped.
template <class C>
double total(const World& world) {
  const Bodies& bodies = world.resource<Bodies>();
  double sum = 0;
  for (const int slot : bodies.slot_of_number)
    sum += world.column<C>().values()[static_cast<std::size_t>(slot)];
  return sum;
}

double largest_tool_force(const World& world) {
  double largest = 0;
  const Column<ToolForce>& force = world.column<ToolForce>();
  for (std::size_t t = 0; t < force.table.rows; ++t)
    largest =
        std::max(largest, Eigen::Map<const Eigen::Vector3d>(force.values() + tool_axes * t).norm());
  return largest;
}

std::unique_ptr<ResultParts> make_parts(const Scene& scene, const World& world) {
  std::vector<ParticleTag> tags = particle_tags(scene, world);
  if (scene.in_space()) return space::result_parts(scene, world, std::move(tags));
  return std::make_unique<PlaneParts>(scene, world, std::move(tags));
}

}  // namespace

Results::Results(const Scene& scene, const World& world)
    : world_(world),
      parts_(make_parts(scene, world)),
      observables_(observables(scene)),
      momentum_(momentum_of(scene)),
      frame_fields_(frame_fields(scene)),
      tables_(bond_tables(scene)),
      shear_(scene, world) {
  const double modulus = *std::ranges::max_element(
      world.column<BulkModulus>().values(),
      world.column<BulkModulus>().values() + world.resource<Bodies>().slots.size());
  stiffness_energy_ = modulus * parts_->volume();
  for (std::size_t i = 0; i < series().size(); ++i) position_[series()[i].name] = i;
  if (const auto outlines = parts_->tool_field())
    frame_fields_.add(
        {{*outlines, [parts = parts_.get()](const Observation&) { return parts->tool_points(); }}});
  for (MeshField& field : mesh_fields(world)) {
    fields_.push_back(std::move(field.info));
    mesh_values_.push_back(std::move(field.values));
  }
  const std::vector<FieldInfo>& beside_mesh = frame_fields_.infos();
  fields_.insert(fields_.end(), beside_mesh.begin(), beside_mesh.end());
}

Observation Results::observation() const {
  return {world_, energies_, shear_, parts_->powder(), min_jacobian()};
}

void Results::take_energies() {
  const Totals& totals = world_.resource<Totals>();
  Energies& e = energies_;
  e.kinetic = total<KineticEnergy>(world_);
  e.elastic = total<ElasticEnergy>(world_);
  e.plastic = world_.has<PlasticWork>() ? total<PlasticWork>(world_) : 0;
  e.hourglass = world_.has<HourglassEnergy>() ? total<HourglassEnergy>(world_) : 0;
  e.contact = totals.contact_energy;
  e.indentation = totals.indentation_work;
  e.friction = totals.friction_work;
  e.damping = totals.damping_work;
  e.bulk_damping = world_.has<DampingWork>() ? total<DampingWork>(world_) : 0;
  if (world_.has<BondTotals>()) {
    e.bonds = world_.resource<BondTotals>().energy;
    e.fracture = world_.resource<BondTotals>().fracture;
  }
  e.external = totals.external_work;
  const double all = e.kinetic + e.elastic + e.plastic + e.hourglass + e.contact + e.indentation +
                     e.friction + e.damping + e.bulk_damping + e.bonds + e.fracture;
  if (first_) initial_energy_ = all - e.external;  // an initial state has energy of its own
  first_ = false;
  e.balance = all - e.external - initial_energy_;
  // "Not smaller" instead of "larger": a NaN must reach the limits.
  if (!(std::abs(e.balance) <= worst_balance_)) worst_balance_ = std::abs(e.balance);
  largest_energy_ = std::max({largest_energy_, std::abs(e.external), std::abs(initial_energy_)});
}

double Results::load() const {
  if (world_.has_table<Tool>() && world_.column<ToolForce>().table.rows > 0)
    return largest_tool_force(world_);
  if (has("cell/stress_xx")) {
    double size = 0;
    for (const char* part : tensor_part_names)
      if (const std::string name = fmt::format("cell/stress_{}", part); has(name))
        size = portable::hypot(size, value(name));
    return size;
  }
  return std::sqrt(std::max(0.0, energies_.elastic + energies_.contact + energies_.bonds));
}

// Samples under hardly any load or with hardly any internal energy do not count: a tenth of the force of a plastic powder
// comes with next to no energy. Which these are is only known at the end, so all samples are kept that no other exceeds in
// all figures. Internal energy is also that in contact springs and bonds: as a round contact begins, most of it is in springs.
void Results::take_kinetic_ratio() {
  const double internal = energies_.internal() + energies_.contact + energies_.bonds;
  largest_load_ = std::max(largest_load_, load());
  largest_internal_ = std::max(largest_internal_, internal);
  const KineticSample now{energies_.kinetic / internal, load(), internal};
  const auto is_first_touch = [&](const KineticSample& sample) {
    return sample.load <= 0.1 * largest_load_ || sample.internal <= 0.01 * largest_internal_;
  };
  const auto outdoes = [](const KineticSample& a, const KineticSample& b) {
    return a.ratio >= b.ratio && a.load >= b.load && a.internal >= b.internal;
  };
  std::erase_if(kinetic_samples_, is_first_touch);
  if (is_first_touch(now)) return;
  for (const KineticSample& other : kinetic_samples_)
    if (outdoes(other, now)) return;
  std::erase_if(kinetic_samples_, [&](const KineticSample& other) { return outdoes(now, other); });
  kinetic_samples_.push_back(now);
}

void Results::take_peaks() {
  const auto take = [](double& peak, double value) {
    if (std::isfinite(value)) peak = std::max(peak, std::abs(value));
  };
  take(peaks_.elastic, energies_.elastic);
  take(peaks_.plastic, energies_.plastic);
  take(peaks_.hourglass, energies_.hourglass);
  take(peaks_.penetration, world_.resource<Totals>().worst_penetration);
  if (world_.has<space::NodeDistance>())
    for (const int slot : world_.resource<Bodies>().slot_of_number)
      take(peaks_.node_distance,
           world_.column<space::NodeDistance>().values()[static_cast<std::size_t>(slot)]);
}

double Results::kinetic_ratio() const {
  double worst = 0;
  for (const KineticSample& sample : kinetic_samples_)
    if (!(sample.ratio <= worst)) worst = sample.ratio;
  return worst;
}

std::vector<double> Results::sample() {
  take_energies();
  take_peaks();
  shear_.sample(energies_.plastic);
  last_ = observables_.read(observation());
  take_kinetic_ratio();
  release_.sample(load(), energies_.elastic, energies_.contact);
  return last_;
}

FrameValues Results::frame_values(VisitMesh mesh) const {
  return [this, mesh = std::move(mesh),
          beside = std::vector<std::vector<double>>()](std::size_t field) mutable {
    const std::size_t of_mesh = mesh_values_.size();
    if (field >= of_mesh) {
      if (field == of_mesh) beside = frame_fields_.read(observation());
      return std::move(beside.at(field - of_mesh));
    }
    std::vector<double> values;
    mesh(field, [&](std::span<const double> of_one) {
      values.insert(values.end(), of_one.begin(), of_one.end());
    });
    return values;
  };
}

std::vector<std::vector<double>> Results::frame() const {
  const FrameValues values = frame_values([this](std::size_t field, const ValueSink& take) {
    visit_all(world_, mesh_values_[field], take);
  });
  std::vector<std::vector<double>> fields;
  for (std::size_t i = 0; i < fields_.size(); ++i) fields.push_back(values(i));
  return fields;
}

double Results::tool_position(int tool, int axis) const {
  return world_.column<ToolPosition>().values()[tool_axes * tool + axis];
}

double Results::value(const std::string& series) const { return last_.at(position_.at(series)); }

// Includes the state just observed, which is only checked by the next step, if there is one.
double Results::min_jacobian() const {
  double minimum = world_.resource<Totals>().min_jacobian;
  for (const int slot : world_.resource<Bodies>().slot_of_number)
    minimum =
        std::min(minimum, world_.column<MinJacobian>().values()[static_cast<std::size_t>(slot)]);
  return minimum;
}

// The forces of a step are those at its ends: where surfaces meet within it, the energy error is up to half of the
// step's work. Fifty steps supply enough work for that to be a hundredth.
double Results::energy_balance_error() const {
  constexpr double round_off = 1e-12, steps_of_a_touch = 50;
  const double unresolved = steps_of_a_touch * world_.resource<Totals>().largest_work;
  return worst_balance_ / std::max({largest_energy_, unresolved, round_off * stiffness_energy_});
}

}  // namespace pulvis
