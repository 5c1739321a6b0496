#include "scenes/space/space_memory.hpp"

#include <algorithm>
#include <vector>

#include "components/body.hpp"
#include "components/highest_mode.hpp"
#include "components/space/bond.hpp"
#include "components/space/contact.hpp"
#include "components/space/formulation.hpp"
#include "engine/chunk_lane.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/spec/yield.hpp"
#include "scenes/tools/bond_rules.hpp"
#include "scenes/tools/contact_rules.hpp"

namespace pulvis::space {
namespace {

// For a compacted powder: rows for everything closer than the skin, from both sides.
constexpr double rows_of_a_face = 2;
// Of a frame: gathered; and for its largest fields, the data packed for the file and the journal.
constexpr std::uint64_t copies_in_flight = 2;

// Volumes of particles during summation, stored volumes, the room, and a frame's copies.
constexpr std::uint64_t density_bytes_a_cell = 100;

template <class... C>
constexpr std::uint64_t size_of_columns() {
  return (0 + ... + (sizeof(typename C::value_type) * C::count));
}

template <class F>
std::uint64_t bytes_of_element(bool plastic) {
  std::uint64_t bytes = size_of_columns<DeviatoricStress<ThreeD, F::points>, MeanStress<1>>();
  if (plastic)
    bytes += size_of_columns<PlasticMetric<ThreeD, F::points>, PlasticStrain<F::points>>();
  if (plastic && F::stabilised) bytes += size_of_columns<PlasticHourglass<ThreeD>>();
  return bytes;
}

std::uint64_t bytes_of_row(bool weakening, bool looked_at) {
  using At = FaceContact;
  return size_of_columns<ContactPair<At>, ContactTouches<At>, Activation<At>, ContactLaw<At>,
                         ContactPoint>() +
         sizeof(PairLoads::Load) + (weakening ? size_of_columns<SlipWeakening<At>>() : 0) +
         (looked_at ? size_of_columns<ContactPointForce>() : 0);
}
std::uint64_t bond_bytes_of_row(const Scene& scene) {
  using At = FaceContact;
  if (!has_bonds(scene)) return 0;
  const BondRules rules = bond_rules(scene);
  if (!BondRules::any(rules.initial) && !BondRules::any(rules.pressed)) return 0;
  return size_of_columns<BondedPoints<At>, BondDamage<At>, BondStrength<At>>() +
         (BondRules::any(rules.initial) ? size_of_columns<BondOffset<At>>() : 0) +
         (BondRules::any(rules.pressed) ? size_of_columns<WeldPressure<At>>() : 0);
}

template <class Is>
bool any_friction(const Scene& scene, const Is& is) {
  return std::ranges::any_of(scene.frictions, [&](const FrictionSpec& f) {
    return is(friction_of(scene, f.first, f.second));
  });
}

}  // namespace

SpaceMemory memory_of(const Scene& scene) {
  std::vector<std::uint64_t> particles(scene.particles.size());
  for (const BodySpec& body : place_bodies(scene))
    particles[static_cast<std::size_t>(body.particle)] += 1;
  using Friction = ContactRules::Friction;
  const bool friction =
      scene.contact.friction > 0 || any_friction(scene, [](const Friction& f) { return f.acts(); });
  const bool weakening = any_friction(scene, [](const Friction& f) { return !f.only_coulomb(); });
  const bool plastic = any_material_yields(scene),
             mode = scene.time.estimate == TimeSpec::Estimate::highest_mode,
             damped = std::ranges::any_of(scene.materials, &MaterialSpec::damped);
  const std::uint64_t element = scene.element.formulation == Formulation::four_point
                                    ? bytes_of_element<EightPoint>(plastic)
                                    : bytes_of_element<OnePoint>(plastic);
  const std::uint64_t node =
      size_of_columns<Position<ThreeD>, Velocity<ThreeD>, InternalForce<ThreeD>>() +
      (damped ? size_of_columns<DampingForce<ThreeD>>() : 0) +
      (mode ? size_of_columns<HighestMode<ThreeD>>() : 0);
  const std::uint64_t outline =
      size_of_columns<ContactForce<ThreeD>>() + (mode ? size_of_columns<ContactSupport>() : 0);
  const std::uint64_t point = size_of_columns<SurfacePosition, SurfaceBefore>() +
                              (friction ? size_of_columns<SurfaceVelocity>() : 0);
  const std::uint64_t row =
      bytes_of_row(weakening, scene.output.contacts) + bond_bytes_of_row(scene);
  SpaceMemory need;
  const auto [x, y, z] = scene.output.density_cells3;
  need.results = density_bytes_a_cell * static_cast<std::uint64_t>(x) *
                 static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(z);
  for (std::size_t c = 0; c < particles.size(); ++c) {
    if (particles[c] == 0) continue;
    const HexMeshSpec& mesh = scene.particles[c].hex_mesh;
    const std::uint64_t lanes = (particles[c] + lane_count - 1) / lane_count * lane_count;
    const auto nodes = static_cast<std::uint64_t>(mesh.nodes()),
               elements = static_cast<std::uint64_t>(mesh.hexahedra()),
               faces = static_cast<std::uint64_t>(mesh.faces()),
               surface = static_cast<std::uint64_t>(mesh.surface_nodes());
    need.columns +=
        lanes * (nodes * node + elements * element +
                 static_cast<std::uint64_t>(mesh.surface_points()) * point + surface * outline);
    need.results += particles[c] * copies_in_flight * sizeof(double) * (6 * nodes + 9 * elements);
    need.contacts += static_cast<std::uint64_t>(rows_of_a_face *
                                                static_cast<double>(particles[c] * faces * row));
  }
  return need;
}

}  // namespace pulvis::space
