#include "scenes/memory_need.hpp"

#include <fmt/format.h>

#include <vector>

#include "components/body.hpp"
#include "components/bond.hpp"
#include "components/cell.hpp"
#include "components/contact.hpp"
#include "components/highest_mode.hpp"
#include "engine/files/output_error.hpp"
#include "engine/machine_memory.hpp"
#include "scenes/grains/grains.hpp"
#include "scenes/meshes/mesh.hpp"
#include "scenes/needs.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/space/space_memory.hpp"

namespace pulvis {
namespace {

constexpr std::uint64_t program_bytes = 64U << 20U;
// For a compacted powder: rows for everything closer than the skin, from both sides.
constexpr double rows_of_an_edge = 3;
constexpr std::uint64_t copies_of_a_frame =
    3;  // gathered, being written to the file, in the journal

// Areas of particles and tools during summation, stored areas, and a frame's copies: 90 were measured.
constexpr std::uint64_t density_bytes_a_cell = 120;

template <class... C>
constexpr std::uint64_t bytes_of() {
  return (0 + ... + (sizeof(typename C::value_type) * C::count));
}

template <class F>
std::uint64_t element_bytes(const Needs& needs) {
  std::uint64_t bytes = bytes_of<DeviatoricStress<TwoD, F::points>, MeanStress<F::volumes>>();
  if (F::stabilised) bytes += bytes_of<HourglassStress>();
  if (needs.plastic)
    bytes += bytes_of<IsochoricScale<F::points>, PlasticMetric<TwoD, F::points>,
                      PlasticStrain<F::points>>();
  if (needs.plastic && F::stabilised) bytes += bytes_of<PlasticHourglass<TwoD>>();
  return bytes;
}

std::uint64_t element_bytes(const Needs& needs) {
  return with_formulation(needs.formulation, [&]<class F>(F) { return element_bytes<F>(needs); });
}

std::uint64_t row_bytes(const Needs& needs) {
  using At = Contact;
  std::uint64_t bytes = bytes_of<ContactPair<At>, ContactTouches<At>, ActivationTravel<At>,
                                 ContactLaw<At>, PointForce<At>, ContactPlace, ClosestPoint>();
  if (needs.friction) bytes += bytes_of<ElasticSlip<At>>();
  if (needs.friction || needs.bonds) bytes += bytes_of<FrictionCouple>();
  if (needs.weakening) bytes += bytes_of<FrictionMore<At>, SlipWeakening<At>>();
  if (needs.adhesion) bytes += bytes_of<AdhesionLaw<At>>();
  if (needs.bonds)
    bytes += bytes_of<BondLawNumber<At>, BondedPoints<At>, BondOffset<At>, BondStrength<At>,
                      BondDamage<At>, CurveAnchor>();
  if (needs.welds) bytes += bytes_of<WeldPressure<At>>();
  if (needs.cell) bytes += bytes_of<ContactImage>();
  return bytes;
}

std::vector<std::uint64_t> particles_of_classes(const Scene& scene) {
  std::vector<std::uint64_t> count(scene.particles.size() + scene.grains.size());
  for (const BodySpec& body : grains_of(scene, place_bodies(scene)))
    count[static_cast<std::size_t>(body.particle)] += 1;
  return count;
}

// Of so many ranks.
MemoryNeed of_ranks(MemoryNeed need, int count, int all) {
  const auto some = static_cast<std::uint64_t>(count);
  need.columns = need.columns * some / static_cast<std::uint64_t>(all);
  need.contacts = need.contacts * some / static_cast<std::uint64_t>(all);
  need.program *= some;
  return need;
}

}  // namespace

MemoryNeed memory_need(const Scene& scene) {
  if (scene.in_space()) {
    const space::SpaceMemory of = space::memory_of(scene);
    return {of.columns, of.contacts, of.results, program_bytes};
  }
  const std::vector<std::uint64_t> particles = particles_of_classes(scene);
  std::uint64_t all = 0;
  for (const std::uint64_t count : particles) all += count;
  const Needs needs = needs_of(scene, all);
  const bool mode = scene.time.estimate == TimeSpec::Estimate::highest_mode;
  std::uint64_t node = bytes_of<Position<TwoD>, Velocity<TwoD>, InternalForce<TwoD>>();
  if (mode) node += bytes_of<HighestMode<TwoD>>();
  if (needs.bulk_damping) node += bytes_of<DampingForce<TwoD>>();
  const std::uint64_t control = bytes_of<CurvePosition, CurveBefore, CurveForce>() +
                                (needs.friction || needs.damping ? bytes_of<CurveVelocity>() : 0);
  const std::uint64_t outline =
      bytes_of<ContactForce<TwoD>>() + (mode ? bytes_of<ContactSupport>() : 0);

  MemoryNeed need;
  need.program = program_bytes;
  need.results = density_bytes_a_cell * static_cast<std::uint64_t>(scene.output.density_cells[0]) *
                 static_cast<std::uint64_t>(scene.output.density_cells[1]);
  for (std::size_t c = 0; c < particles.size(); ++c) {
    if (particles[c] == 0) continue;
    const bool whole = c < scene.particles.size();
    const Shape shape =
        make_shape(whole ? scene.particles[c] : scene.grains[c - scene.particles.size()]);
    const std::uint64_t lanes = (particles[c] + lane_count - 1) / lane_count * lane_count;
    const auto nodes = static_cast<std::uint64_t>(shape.nodes.size());
    const auto edges = static_cast<std::uint64_t>(shape.boundary_nodes);
    const auto elements = static_cast<std::uint64_t>(shape.elements());
    need.columns += lanes * (nodes * node + elements * element_bytes(needs));
    if (needs.contact())
      need.columns +=
          lanes * (edges * outline + static_cast<std::uint64_t>(shape.control_points()) * control);
    need.results += particles[c] * copies_of_a_frame * sizeof(double) * (5 * nodes + 7 * elements);
    if (needs.contact())
      need.contacts += static_cast<std::uint64_t>(
          rows_of_an_edge * static_cast<double>(particles[c] * edges * row_bytes(needs)));
  }
  return need;
}

MemoryNeed require_memory(const Scene& scene, const std::vector<MachineMemory>& machines) {
  const MemoryNeed need = memory_need(scene);
  int all = 0;
  for (const MachineMemory& machine : machines) all += machine.ranks;
  MemoryNeed of_all = need;
  const auto require = [&](const MachineMemory& machine, int count, std::uint64_t left) {
    const std::uint64_t needed = of_ranks(of_all, count, all).total();
    if (needed <= left) return;
    const std::string where = machine.name.empty() ? ""
                                                   : fmt::format(" on {} for {} of its {} ranks",
                                                                 machine.name, count, all);
    throw OutputError(scene.file, "run it",
                      fmt::format("it needs about {} of memory{}, but only {} are available",
                                  bytes_text(needed), where, bytes_text(left)));
  };
  for (const MachineMemory& machine : machines) {
    require(machine, machine.ranks, machine.left);
    require(machine, 1, machine.left_to_each);
    of_all.results = 0;  // on the first machine only
  }
  return need;
}

}  // namespace pulvis
